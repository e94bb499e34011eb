// The types of glint-lint, from the schema of the report: node types.cjs check-report.schema.json index.d.ts
'use strict';
const fs = require('fs');
const schema = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));

const named = (name) => name[0].toUpperCase() + name.slice(1);
const scalars = { integer: 'number', number: 'number', string: 'string', boolean: 'boolean', null: 'null' };

function type(node, indent) {
  if (node.$ref) {
    const name = node.$ref.split('/').pop();
    const target = schema.definitions[name];
    return target.type === 'object' || target.oneOf ? named(name) : type(target, indent);
  }
  if ('const' in node) return JSON.stringify(node.const);
  if (node.enum) return node.enum.map((value) => JSON.stringify(value)).join(' | ');
  const any = node.oneOf || node.anyOf;
  if (any) return any.map((one) => type(one, indent)).join(' | ');
  if (Array.isArray(node.type)) return node.type.map((one) => scalars[one]).join(' | ');
  if (node.type === 'array') return `Array<${type(node.items, indent)}>`;
  if (node.type === 'object') return object(node, indent);
  if (scalars[node.type]) return scalars[node.type];
  throw new Error(`no type for ${JSON.stringify(node)}`);
}

function object(node, indent) {
  if (!node.properties) return `Record<string, ${type(node.additionalProperties, indent)}>`;
  const inner = `${indent}  `;
  const lines = Object.entries(node.properties).map(([name, value]) => {
    const doc = value.description ? `${inner}/** ${value.description} */\n` : '';
    const optional = (node.required || []).includes(name) ? '' : '?';
    return `${doc}${inner}${name}${optional}: ${type(value, inner)};\n`;
  });
  return `{\n${lines.join('')}${indent}}`;
}

const interfaces = Object.entries(schema.definitions)
  .filter(([, node]) => node.type === 'object')
  .map(([name, node]) => `export interface ${named(name)} ${object(node, '')}\n`);
const text = `// Made from docs/schema/check-report.schema.json: do not edit.

/** Files by their paths, which are relative to the scene's folder: text, or bytes of meshes and images. */
export type Files = Record<string, string | Uint8Array>;

export interface CheckOptions {
  /** The scene's own path, which says its spelling; scene.glint.yaml or scene.glint.xml if left out. */
  name?: string;
  /** More options of 'glint check', such as ['--fail-on', 'warning']. */
  args?: string[];
}

${interfaces.join('\n')}
/** ${schema.description} */
export interface Report ${object(schema, '')}

/** The report of one scene, and the exit status: 0 where nothing failed. */
export function check(text: string, files?: Files, options?: CheckOptions): Promise<Report & { status: number }>;

export interface Result {
  status: number;
  out: string;
  err: string;
}

/** Any command: run(['convert', 'scene.glint.yaml', '-'], {'scene.glint.yaml': text}). Files that it writes are gone with it. */
export function run(words: string[], files?: Files): Promise<Result>;

export interface Server {
  /** A message of the client. 'exit' closes the server. */
  take(message: object): void;
  /** A file beside the scene, new or changed; tell the server by workspace/didChangeWatchedFiles. */
  write(name: string, content: string | Uint8Array): void;
  /** Returns the exit status: 0 after 'shutdown'. */
  close(): number;
  /** The URI of the folder that holds the files. */
  root: string;
}

/** The language server (LSP 3.17), message by message; 'send' takes what it says. */
export function serve(send: (message: object) => void, files?: Files): Promise<Server>;
`;
fs.writeFileSync(process.argv[3], text);
