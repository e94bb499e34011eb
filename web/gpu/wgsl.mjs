// From SPIR-V to WGSL: node wgsl.mjs MODULES IN.spv OUT.wgsl, where MODULES is the folder that npm has filled (tools/webgpu.sh). naga
// translates; what it does not support is replaced before and after:
//   - Operations on specialization constants pass it as constants with names, and become constant expressions of WGSL afterwards.
//     Each with a SpecId becomes a line `const glint_IDk: TYPE = DEFAULT;`: library.js puts a program's values there before the
//     text is compiled, so array lengths may depend on them.
//   - WGSL has no NaN constant: it is made from its bits when the kernel runs.
//   - Float controls are left out: WGSL has none.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, source, target] = process.argv.slice(2);
const { parseSpirv, validate, writeWgsl } = await import(pathToFileURL(path.resolve(modules, 'node_modules/naga-wasm/dist/node.js')));

const NAME = 5, EXTENSION = 10, EXECUTION_MODE = 16, CAPABILITY = 17;
const TYPE_BOOL = 20, TYPE_INT = 21, TYPE_FLOAT = 22, TYPE_ARRAY = 28;
const TRUE = 41, FALSE = 42, CONSTANT = 43, COMPOSITE = 44, SPEC_TRUE = 48, SPEC_FALSE = 49, SPEC = 50, SPEC_COMPOSITE = 51, SPEC_OP = 52;
const DECORATE = 71, MEMBER_DECORATE = 72;
const TYPE_POINTER = 32, VARIABLE = 59;
const SPEC_ID = 1, NON_WRITABLE = 24, BINDING = 33, BUILT_IN = 11, WORKGROUP_SIZE = 25; // decorations; a value of BuiltIn
const isFloatControl = (n) => n >= 4464 && n <= 4468; // capabilities
const isFloatMode = (n) => n >= 4459 && n <= 4463;
const LENGTH = 1000003; // of an array, while naga has it: larger than any other, plus the index of its constant
// Operations on specialization constants, by their operands.
const EXPRESSIONS = {
  128: (a, b) => `(${a} + ${b})`, 130: (a, b) => `(${a} - ${b})`, 132: (a, b) => `(${a} * ${b})`, 134: (a, b) => `(${a} / ${b})`, 137: (a, b) => `(${a} % ${b})`,
  164: (a, b) => `(${a} == ${b})`, 165: (a, b) => `(${a} != ${b})`, 166: (a, b) => `(${a} || ${b})`, 167: (a, b) => `(${a} && ${b})`, 168: (a) => `(!${a})`,
  169: (a, b, c) => `select(${c}, ${b}, ${a})`, 170: (a, b) => `(${a} == ${b})`, 171: (a, b) => `(${a} != ${b})`, 172: (a, b) => `(${a} > ${b})`,
  174: (a, b) => `(${a} >= ${b})`, 176: (a, b) => `(${a} < ${b})`, 178: (a, b) => `(${a} <= ${b})`, 194: (a, b) => `(${a} >> ${b})`, 196: (a, b) => `(${a} << ${b})`,
  197: (a, b) => `(${a} | ${b})`, 198: (a, b) => `(${a} ^ ${b})`, 199: (a, b) => `(${a} & ${b})`,
};
const ARITHMETIC = new Set([128, 130, 132, 134, 137, 197, 198, 199]); // on whole numbers: SPIR-V asks for no signs that agree

const bytes = fs.readFileSync(source);
const words = new Uint32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
let ids = words[3];
const code = []; // one entry per instruction: [operation, operands...]
for (let at = 5; at < words.length; at += words[at] >>> 16) code.push([words[at] & 0xffff, ...words.subarray(at + 1, at + (words[at] >>> 16))]);

// ---- what is known of it

const types = new Map(); // by id: bool, u32, i32, f32
const specIds = new Map();
for (const [op, a, b, c] of code) {
  if (op === TYPE_BOOL) types.set(a, 'bool');
  if (op === TYPE_INT) types.set(a, c ? 'i32' : 'u32');
  if (op === TYPE_FLOAT) types.set(a, 'f32');
  if (op === DECORATE && b === SPEC_ID) specIds.set(a, c);
}
const literal = (type, bits) => {
  if (type === 'bool') return bits ? 'true' : 'false';
  return type === 'u32' ? `${bits}u` : type === 'i32' ? `i32(${bits}u)` : `bitcast<f32>(${bits}u)`;
};

// Bindings of buffers that no kernel writes; naga does not distinguish them.
const readOnly = new Set();
const blocks = new Set(code.filter(([op, , , c]) => op === MEMBER_DECORATE && c === NON_WRITABLE).map(([, struct]) => struct));
const pointers = new Set(code.filter(([op, , , struct]) => op === TYPE_POINTER && blocks.has(struct)).map(([, id]) => id));
const variables = new Set(code.filter(([op, type]) => op === VARIABLE && pointers.has(type)).map(([, , id]) => id));
for (const [op, id, decoration, binding] of code) if (op === DECORATE && decoration === BINDING && variables.has(id)) readOnly.add(binding);

// ---- constants: their names, and what stands for them

const values = new Map(); // by id: its text as an operand of an expression
const kinds = new Map(); // by id: u32, i32, ...
const named = []; // {id, name, type, text}: in order, each after those it needs
const lengths = new Map(); // by id of a constant: the id of a plain one that takes its place
let workgroup = null;
const out = [];
const name = (id, type, text, given) => {
  const word = given || `glint_${named.length}c`;
  named.push({ id, name: word, type, text });
  values.set(id, word);
};
for (const [op, ...words] of code) {
  const [typeId, id] = words;
  const type = types.get(typeId);
  if (type) kinds.set(id, type);
  const plain = (bits) => (type === 'bool' ? [bits ? TRUE : FALSE, typeId, id] : [CONSTANT, typeId, id, bits]);
  if (op === CAPABILITY && isFloatControl(typeId)) continue;
  if (op === EXTENSION && String.fromCharCode(...new Uint8Array(new Uint32Array(words).buffer)).startsWith('SPV_KHR_float_controls')) continue;
  if (op === EXECUTION_MODE && isFloatMode(id)) continue;
  if (op === DECORATE && id === SPEC_ID) continue;
  if (op === DECORATE && id === BUILT_IN && words[2] === WORKGROUP_SIZE) continue;
  if (op === SPEC_TRUE || op === SPEC_FALSE || op === SPEC) {
    const bits = op === SPEC ? words[2] : op === SPEC_TRUE ? 1 : 0;
    if (!type || !specIds.has(id)) throw new Error(`a specialization constant of an unknown type, or without a number: ${id}`);
    name(id, type, literal(type, bits), `glint_${specIds.get(id)}k`);
    out.push(plain(bits));
  } else if (op === SPEC_OP) {
    const operands = words.slice(3).map((one) => (ARITHMETIC.has(words[2]) && kinds.get(one) !== type ? `${type}(${values.get(one)})` : values.get(one)));
    if (!type || !EXPRESSIONS[words[2]] || words.slice(3).some((one) => !values.has(one))) throw new Error(`operation ${words[2]} on specialization constants`);
    name(id, type, EXPRESSIONS[words[2]](...operands));
    out.push(plain(1));
  } else if (op === SPEC_COMPOSITE) {
    workgroup = values.get(words[2]); // the size of a workgroup: glslang makes no other composite
    out.push([COMPOSITE, ...words]);
  } else if (op === TYPE_ARRAY && named.some((one) => one.id === words[2])) {
    const at = named.findIndex((one) => one.id === words[2]);
    const uint = [...types].find(([, one]) => one === 'u32')[0];
    if (!lengths.has(at)) {
      lengths.set(at, ids);
      out.push([CONSTANT, uint, ids++, LENGTH + at]);
    }
    out.push([op, words[0], words[1], lengths.get(at)]);
  } else {
    if (op === TRUE || op === FALSE) values.set(id, op === TRUE ? 'true' : 'false');
    if (op === CONSTANT && type) values.set(id, literal(type, words[2]));
    out.push([op, ...words]);
  }
}

// ---- through naga

const text = (word) => {
  const padded = Buffer.alloc((word.length >> 2) * 4 + 4);
  padded.write(word);
  return new Uint32Array(padded.buffer, padded.byteOffset, padded.length / 4);
};
const names = named.map((one) => [NAME, one.id, ...text(one.name)]);
out.splice(out.findIndex(([op]) => op === DECORATE || op === MEMBER_DECORATE), 0, ...names);
const rewritten = [words[0], words[1], words[2], ids, 0];
for (const one of out) rewritten.push((one.length << 16) | one[0], ...one.slice(1));
let wgsl;
try {
  const module = parseSpirv(new Uint32Array(rewritten));
  wgsl = writeWgsl(module, validate(module), {});
} catch (error) {
  console.error(`${source}: naga: ${error.kind} ${error.message}\n${(error.formatted || '').slice(0, 2000)}`);
  process.exit(1);
}

// ---- and behind it

const once = (pattern, by) => {
  if (!pattern.test(wgsl)) throw new Error(`${source}: naga's text has no ${pattern}`);
  wgsl = wgsl.replace(pattern, by);
};
named.forEach(({ name }, at) => {
  if (lengths.has(at)) wgsl = wgsl.replaceAll(`, ${LENGTH + at}>`, `, ${name}>`);
  wgsl = wgsl.replace(new RegExp(`^const ${name}: .*;\\n`, 'm'), '');
});
let head = named.map(({ name, type, text }) => `const ${name}: ${type} = ${text};\n`).join('');
wgsl = wgsl.replaceAll(/bitcast<f32>\((\d+)u\)/g, (whole, bits) => {
  if ((bits & 0x7f800000) !== 0x7f800000) return whole;
  const name = `glint_${bits}v`;
  if (!head.includes(name)) head += `var<private> ${name}: u32 = ${bits}u;\n`;
  return `bitcast<f32>(${name})`;
});
for (const binding of readOnly) once(new RegExp(`(@binding\\(${binding}\\)\\s*var<storage), read_write>`), '$1>');
if (workgroup) once(/@workgroup_size\(\d+, 1, 1\)/, `@workgroup_size(${workgroup}, 1, 1)`);
fs.writeFileSync(target, head + wgsl.replaceAll(/^ +/gm, ''));
