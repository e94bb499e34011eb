'use strict';
const fs = require('fs');
const path = require('path');
const modules = process.env.GLINT_MODULES;
const Ajv = require(path.join(modules, 'ajv'));
const YAML = require(path.join(modules, 'yaml'));
const [, , schemaPath, source] = process.argv;
process.removeAllListeners('warning');

const ajv = new (Ajv.default || Ajv)({ strict: false, allErrors: true });
const validate = ajv.compile(JSON.parse(fs.readFileSync(schemaPath, 'utf8')));

function accepts(file) {
  const options = { merge: true, version: '1.2', logLevel: 'silent' };
  const documents = YAML.parseAllDocuments(fs.readFileSync(file, 'utf8'), options);
  const document = documents[0];
  if (documents.length !== 1 || document.errors.length) return false;
  let value;
  try {
    value = document.toJS({ maxAliasCount: -1 });
  } catch (error) {
    return false; // an alias without its anchor, or within it
  }
  return validate(value);
}

const checkerOnly = new Set(fs.readFileSync(path.join(source, 'tests/invalid/checker_only.txt'), 'utf8').split('\n'));
let cases = 0;
let wrong = 0;
for (const name of fs.readdirSync(path.join(source, 'tests/invalid')).sort()) {
  const folder = path.join(source, 'tests/invalid', name);
  const file = path.join(folder, 'case.yaml');
  if (!fs.existsSync(file) || name.endsWith('_command')) continue;
  const isError = /: error: /.test(fs.readFileSync(path.join(folder, 'expected.txt'), 'utf8'));
  const wanted = !isError || checkerOnly.has(name);
  cases++;
  if (accepts(file) !== wanted) {
    wrong++;
    console.log(`${name}: wanted ${wanted ? 'accepted' : 'refused'}`);
  }
}
for (const folder of ['scenes', 'scenes/elements']) {
  for (const name of fs.readdirSync(path.join(source, folder)).filter((n) => n.endsWith('.glint.yaml'))) {
    cases++;
    if (!accepts(path.join(source, folder, name))) {
      wrong++;
      console.log(`${name}: refused: ${ajv.errorsText(validate.errors)}`);
    }
  }
}
console.log(`${cases} files, ${wrong} verdicts that differ`);
process.exit(wrong ? 1 : 0);
