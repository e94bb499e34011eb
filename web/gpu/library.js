// WebGPU for tracer/gpu/gpu_web.c, which describes each function: a library for emscripten, linked into glint_gpu.js. Functions that wait
// return a promise and are marked `suspends`: whoever instantiates the module wraps them in WebAssembly.Suspending, and calls
// Module.run(words), a promise of the exit status, instead of callMain. Module.kernel(name) returns a promise of a kernel's WGSL.
var gpuweb = {
  $WEB: {
    device: null, // kept from run to run, with what was compiled
    adapter: null,
    fault: '', // the device's error message
    lost: '',
    buffers: [null],
    programs: [null],
    known: {}, // programs by kernel and constants
    layouts: {},
    texts: {},
    spare: {}, // buffers for bindings that a kernel declares but does not use
    hosts: [], // copies to the module's memory: recorded, and submitted
    due: [],
    encoder: null,
    pass: null,
    pushes: null,
    pushed: null,
    count: 0, // dispatches recorded
    begun: 0,
    PUSH_BYTES: 256, // a dispatch's part of `pushes`
    PUSHES: 256,

    say: function (at, text) {
      stringToUTF8(String(text), at, 512);
      return 0;
    },
    record: function () {
      if (!WEB.encoder) WEB.encoder = WEB.device.createCommandEncoder();
      return WEB.encoder;
    },
    endPass: function () {
      if (WEB.pass) WEB.pass.end();
      WEB.pass = null;
    },
    // Ends the pass, for commands that are recorded between passes.
    between: function () {
      WEB.record();
      WEB.endPass();
      return WEB.encoder;
    },
    submit: function () {
      if (!WEB.encoder) return;
      WEB.endPass();
      if (WEB.count) WEB.device.queue.writeBuffer(WEB.pushes, 0, WEB.pushed.buffer, 0, WEB.count * WEB.PUSH_BYTES);
      WEB.begun = performance.now();
      WEB.device.queue.submit([WEB.encoder.finish()]);
      WEB.due = WEB.due.concat(WEB.hosts);
      WEB.hosts = [];
      WEB.encoder = null;
      WEB.count = 0;
    },
    // The error message of an operation that waits; '' if there is none.
    watched: async function (filters, work) {
      filters.forEach(function (one) { WEB.device.pushErrorScope(one); });
      var value = work();
      var errors = await Promise.all(filters.map(function () { return WEB.device.popErrorScope(); }));
      var found = errors.filter(function (one) { return one; })[0];
      return { value: value, fault: found ? found.message : '' };
    },
    spareFor: function (binding, isUniform) {
      if (!WEB.spare[binding]) WEB.spare[binding] = WEB.device.createBuffer({ size: 1024, usage: isUniform ? GPUBufferUsage.UNIFORM : GPUBufferUsage.STORAGE });
      return WEB.spare[binding];
    },
    // The bindings that a kernel's text declares.
    bindings: function (text) {
      var found = [], pattern = /@group\(0\) @binding\((\d+)\)\s*var<(uniform|storage)(, read_write)?>/g, one;
      while ((one = pattern.exec(text))) found.push({ binding: +one[1], type: one[2] === 'uniform' ? 'uniform' : one[3] ? 'storage' : 'read-only-storage' });
      return found;
    },
  },

  gpuweb_take_main__deps: ['$WEB'],
  gpuweb_take_main: function (run) {
    Module['run'] = async function (words) {
      var main = WebAssembly.promising(wasmTable.get(run));
      var all = ['glint'].concat(words), stack = stackSave();
      var list = stackAlloc(4 * (all.length + 1));
      all.forEach(function (word, i) { HEAP32[(list >> 2) + i] = allocateUTF8OnStack(word); });
      HEAP32[(list >> 2) + all.length] = 0;
      try {
        return await main(all.length, list);
      } catch (error) {
        if (error instanceof ExitStatus) return error.status;
        throw error;
      } finally {
        stackRestore(stack);
      }
    };
  },

  gpuweb_open__deps: ['$WEB'],
  gpuweb_open__postset: '_gpuweb_open.suspends = true;',
  gpuweb_open: async function (name, nameBytes, storage, isCpu) {
    if (WEB.lost) WEB.device = null;
    if (!WEB.device) {
      WEB.lost = WEB.fault = '';
      WEB.known = {}; WEB.layouts = {}; WEB.spare = {}; WEB.buffers = [null]; WEB.programs = [null]; WEB.encoder = WEB.pass = null; WEB.hosts = []; WEB.due = []; WEB.begun = 0;
      var gpu = typeof navigator === 'undefined' ? null : navigator.gpu;
      var adapter = gpu ? await gpu.requestAdapter({ powerPreference: 'high-performance' }) : null;
      if (!adapter) return 0;
      var most = Math.min(adapter.limits.maxStorageBufferBindingSize, adapter.limits.maxBufferSize);
      var device = await adapter.requestDevice({ requiredLimits: { maxStorageBufferBindingSize: most, maxBufferSize: most } });
      device.addEventListener('uncapturederror', function (event) { WEB.fault = WEB.fault || event.error.message; });
      device.lost.then(function (info) { if (WEB.device === device) WEB.lost = info.message || 'the device is lost'; });
      WEB.device = device;
      WEB.adapter = adapter;
      WEB.most = most - most % 16;
      WEB.pushes = device.createBuffer({ size: WEB.PUSH_BYTES * WEB.PUSHES, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
      WEB.pushed = new Uint32Array(WEB.PUSH_BYTES * WEB.PUSHES / 4);
    }
    var info = WEB.adapter.info;
    stringToUTF8([info.vendor, info.architecture, info.description].filter(Boolean).join(' ') || 'WebGPU', name, nameBytes);
    HEAPF64[storage >> 3] = WEB.most;
    HEAP32[isCpu >> 2] = info.isFallbackAdapter || WEB.adapter.isFallbackAdapter ? 1 : 0;
    return 1;
  },
  gpuweb_close__deps: ['$WEB'],
  gpuweb_close: function () {
    WEB.endPass();
    WEB.encoder = null;
    WEB.count = 0;
    WEB.hosts = [];
    WEB.due = [];
  },

  gpuweb_buffer__deps: ['$WEB'],
  gpuweb_buffer__postset: '_gpuweb_buffer.suspends = true;',
  gpuweb_buffer: async function (use, bytes, why) {
    var usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST;
    if (use === 4) usage = GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST; // GPU_UNIFORM
    if (use === 5) usage = GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST; // GPU_HOST
    var made = await WEB.watched(['validation', 'out-of-memory'], function () { return WEB.device.createBuffer({ size: bytes, usage: usage }); });
    if (made.fault) return WEB.say(why, made.fault);
    made.value.uniform = use === 4;
    return WEB.buffers.push(made.value) - 1;
  },
  gpuweb_grow__deps: ['$WEB'],
  gpuweb_grow__postset: '_gpuweb_grow.suspends = true;',
  gpuweb_grow: async function (id, bytes, why) {
    var old = WEB.buffers[id];
    var made = await WEB.watched(['validation', 'out-of-memory'], function () { return WEB.device.createBuffer({ size: bytes, usage: old.usage }); });
    if (made.fault) return WEB.say(why, made.fault);
    WEB.between().copyBufferToBuffer(old, 0, made.value, 0, old.size);
    WEB.submit();
    old.destroy();
    WEB.buffers[id] = made.value;
    return 1;
  },
  gpuweb_drop__deps: ['$WEB'],
  gpuweb_drop: function (id) {
    WEB.submit();
    WEB.buffers[id].destroy();
    WEB.buffers[id] = null;
  },
  gpuweb_write__deps: ['$WEB'],
  gpuweb_write: function (id, offset, data, bytes) {
    var buffer = WEB.buffers[id];
    if (!buffer.uniform) WEB.submit(); // after what was recorded
    WEB.device.queue.writeBuffer(buffer, offset, HEAPU8.buffer, data, Math.ceil(bytes / 4) * 4);
  },
  gpuweb_read__deps: ['$WEB'],
  gpuweb_read__postset: '_gpuweb_read.suspends = true;',
  gpuweb_read: async function (id, offset, data, bytes, why) {
    var size = Math.ceil(bytes / 4) * 4;
    try {
      var made = await WEB.watched(['validation', 'out-of-memory'], function () {
        var staging = WEB.device.createBuffer({ size: size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
        WEB.between().copyBufferToBuffer(WEB.buffers[id], offset, staging, 0, size);
        WEB.submit();
        return staging;
      });
      if (made.fault) return WEB.say(why, made.fault);
      await made.value.mapAsync(GPUMapMode.READ);
      HEAPU8.set(new Uint8Array(made.value.getMappedRange(), 0, bytes), data);
      made.value.destroy();
      return 1;
    } catch (error) {
      return WEB.say(why, error.message);
    }
  },

  gpuweb_program__deps: ['$WEB'],
  gpuweb_program__postset: '_gpuweb_program.suspends = true;',
  gpuweb_program: async function (kernel, constants, count, why) {
    var name = UTF8ToString(kernel);
    var values = Array.from(HEAPU32.subarray(constants >> 2, (constants >> 2) + count));
    var key = name + ' ' + values.join(' ');
    if (WEB.known[key]) return WEB.known[key];
    try {
      WEB.texts[name] = WEB.texts[name] || (await Module['kernel'](name));
      var text = WEB.texts[name].replace(/^const glint_(\d+)k: (bool|u32) = .*;$/gm, function (line, id, type) {
        return 'const glint_' + id + 'k: ' + type + ' = ' + (type === 'bool' ? (values[id] ? 'true' : 'false') : values[id] + 'u') + ';';
      });
      var bindings = WEB.bindings(text);
      var layout = WEB.device.createBindGroupLayout({
        entries: bindings.map(function (one) {
          return { binding: one.binding, visibility: GPUShaderStage.COMPUTE, buffer: { type: one.type, hasDynamicOffset: one.binding === 19 } };
        }),
      });
      var pipeline = await WEB.device.createComputePipelineAsync({
        layout: WEB.device.createPipelineLayout({ bindGroupLayouts: [layout] }),
        compute: { module: WEB.device.createShaderModule({ code: text }), entryPoint: 'main' },
      });
    } catch (error) {
      return WEB.say(why, 'the kernel ' + name + ' is not compiled: ' + error.message);
    }
    WEB.programs.push({ pipeline: pipeline, layout: layout, bindings: bindings });
    return (WEB.known[key] = WEB.programs.length - 1);
  },
  gpuweb_dispatch__deps: ['$WEB'],
  gpuweb_dispatch: function (id, ids, count, x, y, push, pushCount) {
    var program = WEB.programs[id], buffers = HEAP32.subarray(ids >> 2, (ids >> 2) + count);
    if (WEB.count === WEB.PUSHES) WEB.submit();
    WEB.pushed.set(HEAPU32.subarray(push >> 2, (push >> 2) + pushCount), WEB.count * WEB.PUSH_BYTES / 4);
    var entries = program.bindings.map(function (one) {
      if (one.binding === 19) return { binding: 19, resource: { buffer: WEB.pushes, size: WEB.PUSH_BYTES } };
      return { binding: one.binding, resource: { buffer: WEB.buffers[buffers[one.binding]] || WEB.spareFor(one.binding, one.type === 'uniform') } };
    });
    WEB.record();
    if (!WEB.pass) WEB.pass = WEB.encoder.beginComputePass();
    WEB.pass.setPipeline(program.pipeline);
    WEB.pass.setBindGroup(0, WEB.device.createBindGroup({ layout: program.layout, entries: entries }), [WEB.count * WEB.PUSH_BYTES]);
    WEB.pass.dispatchWorkgroups(x, y);
    WEB.count++;
  },
  gpuweb_copy__deps: ['$WEB'],
  gpuweb_copy: function (from, offset, to, bytes, contents) {
    WEB.between().copyBufferToBuffer(WEB.buffers[from], offset, WEB.buffers[to], 0, bytes);
    if (contents) WEB.hosts = WEB.hosts.filter(function (one) { return one.to !== to; }).concat({ to: to, bytes: bytes, contents: contents });
  },
  gpuweb_clear__deps: ['$WEB'],
  gpuweb_clear: function (id, offset, bytes) {
    WEB.between().clearBuffer(WEB.buffers[id], offset, bytes);
  },
  gpuweb_submit__deps: ['$WEB'],
  gpuweb_submit: function () {
    WEB.submit();
  },
  gpuweb_wait__deps: ['$WEB'],
  gpuweb_wait__postset: '_gpuweb_wait.suspends = true;',
  gpuweb_wait: async function (why) {
    if (!WEB.begun) return 0;
    try {
      await WEB.device.queue.onSubmittedWorkDone();
      var seconds = (performance.now() - WEB.begun) / 1e3;
      WEB.begun = 0;
      for (var host of WEB.due.splice(0)) {
        var buffer = WEB.buffers[host.to];
        await buffer.mapAsync(GPUMapMode.READ);
        HEAPU8.set(new Uint8Array(buffer.getMappedRange(), 0, host.bytes), host.contents);
        buffer.unmap();
      }
      if (!WEB.lost && !WEB.fault) return seconds;
    } catch (error) {
      WEB.fault = WEB.fault || error.message;
    }
    WEB.say(why, WEB.lost || WEB.fault);
    WEB.fault = '';
    return WEB.lost ? -2 : -1;
  },
};
mergeInto(LibraryManager.library, gpuweb);
