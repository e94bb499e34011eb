// validator.js GLINT SAMPLE...: what the Khronos validator and `glint check` say of the samples and of files with one
// mistake each. A row says the validator's rule and glint's code for it; "" where glint is silent on purpose, because a
// picture does not depend on it. docs/gltf.md has the table.
const fs = require('fs'), path = require('path'), { spawnSync } = require('child_process');
const validator = require('gltf-validator');
const [glint, ...samples] = process.argv.slice(2);

function triangle() {
  const bytes = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
  return {
    asset: { version: '2.0' },
    buffers: [{ byteLength: 36, uri: 'data:application/octet-stream;base64,' + bytes.toString('base64') }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
  };
}
const rows = [
  ['UNDEFINED_PROPERTY', 'E617', g => delete g.accessors[0].componentType],
  ['TYPE_MISMATCH', 'E617', g => g.accessors[0].count = 'three'],
  ['UNRESOLVED_REFERENCE', 'E617', g => g.nodes[0].mesh = 4],
  ['NODE_LOOP', 'E617', g => g.nodes = [{ mesh: 0, children: [1] }, { children: [0] }]],
  ['ARRAY_LENGTH_NOT_IN_LIST', 'E617', g => g.nodes[0].translation = [1, 2]],
  ['VALUE_NOT_IN_LIST', 'E617', g => g.accessors[0].componentType = 5124],
  ['BUFFER_VIEW_TOO_LONG', 'E618', g => g.bufferViews[0].byteLength = 40],
  ['BUFFER_BYTE_LENGTH_MISMATCH', 'E618', g => g.buffers[0].byteLength = 48],
  ['ACCESSOR_TOO_LONG', 'E618', g => g.accessors[0].count = 4],
  ['ACCESSOR_MAX_MISMATCH', 'W611', g => g.accessors[0].max = [2, 1, 0]],
  ['ACCESSOR_MIN_MISMATCH', 'W611', g => g.accessors[0].min = [-1, 0, 0]],
  ['MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS', 'W611', g => { delete g.accessors[0].min; delete g.accessors[0].max; }],
  ['ROTATION_NON_UNIT', 'W611', g => g.nodes[0].rotation = [0, 0, 1, 1]],
  ['UNSUPPORTED_EXTENSION', 'E619', g => { g.extensionsUsed = g.extensionsRequired = ['KHR_draco_mesh_compression']; }],
  ['NODE_MATRIX_TRS', '', g => { g.nodes[0].matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]; g.nodes[0].translation = [0, 0, 1]; }],
  ['UNDECLARED_EXTENSION', '', g => { g.materials = [{ extensions: { KHR_materials_unlit: {} } }]; g.meshes[0].primitives[0].material = 0; }],
];

const check = file => spawnSync(glint, ['check', file], { encoding: 'utf8' });
const validate = file => validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
  externalResourceFunction: uri => Promise.resolve(new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))),
});
let failed = 0;
const say = (good, text) => { console.log((good ? 'ok   ' : 'FAIL ') + text); failed |= !good; };

(async () => {
  for (const sample of samples) {
    const report = await validate(sample), mine = check(sample);
    say(report.issues.numErrors === 0, `${path.basename(sample)}: the validator has no errors ` +
        report.issues.messages.filter(m => m.severity === 0).slice(0, 2).map(m => m.code + ' ' + m.pointer));
    say(mine.status === 0, `${path.basename(sample)}: nor has glint`);
  }
  const bare = triangle();
  for (const [rule, code, change] of [['', '', () => 0], ...rows]) {
    const g = JSON.parse(JSON.stringify(bare));
    change(g);
    fs.writeFileSync('case.gltf', JSON.stringify(g));
    const codes = (await validate('case.gltf')).issues.messages.filter(m => m.severity < 3).map(m => m.code);
    const mine = check('case.gltf'), found = (mine.stdout + mine.stderr).match(/\[([EW]6\d\d)\]/);
    say(rule ? codes.includes(rule) : codes.length === 0, `${rule || 'a file without mistakes'}: the validator says ${codes.join(' ') || 'nothing'}`);
    say((found ? found[1] : '') === code, `${rule}: glint says ${found ? found[1] : 'nothing'}, wanted ${code || 'nothing'}` );
  }
  process.exit(failed);
})();
