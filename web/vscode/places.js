// Where the editor's files are in the module's file system: those of the machine (file:) by their own paths, others, as in a browser or on
// another machine, in a folder named after their scheme and authority.
import * as vscode from 'vscode';

const OTHERS = '/.editor';
const LARGEST = 1 << 29; // bytes of a file that is fetched

export function pathOf(uri) {
  const path = uri.path || '/';
  return uri.scheme === 'file' && !uri.authority ? path : `${OTHERS}/${uri.scheme}/${encodeURIComponent(uri.authority) || '-'}${path}`;
}

// null: no file of the editor has this path.
export function uriOf(path) {
  if (path !== OTHERS && !path.startsWith(`${OTHERS}/`)) return vscode.Uri.from({ scheme: 'file', path });
  const [, , scheme, authority, ...rest] = path.split('/');
  if (!scheme || !authority) return null;
  return vscode.Uri.from({ scheme, authority: authority === '-' ? '' : decodeURIComponent(authority), path: `/${rest.join('/')}` });
}

// URIs as the protocol writes them. A document that was never saved keeps its name.
export const toProtocol = (uri) => (uri.scheme === 'untitled' ? uri.toString() : vscode.Uri.from({ scheme: 'file', path: pathOf(uri) }).toString());
export const fromProtocol = (text) => {
  const uri = vscode.Uri.parse(text);
  return uri.scheme === 'file' ? uriOf(uri.path) || uri : uri;
};

async function read(path, log) {
  const uri = uriOf(path);
  if (!uri) return { path };
  try {
    const { type, size } = await vscode.workspace.fs.stat(uri);
    if (type & vscode.FileType.Directory) return { path, folder: true };
    if (size > LARGEST) {
      log(`${path} has ${size} bytes: the extension reads files of at most ${LARGEST} bytes`);
      return { path };
    }
    return { path, bytes: await vscode.workspace.fs.readFile(uri) };
  } catch {
    return { path }; // it is missing, or we may not read it
  }
}

async function list(path) {
  const uri = uriOf(path);
  if (!uri) return { path };
  try {
    const entries = await vscode.workspace.fs.readDirectory(uri);
    return { path, folder: entries.map(([name, type]) => ({ name, file: !(type & vscode.FileType.Directory) })) };
  } catch {
    return { path };
  }
}

// Answers what a worker wants (worker.js).
export const answer = ({ files, folders }, log) => Promise.all([...files.map((path) => read(path, log)), ...folders.map(list)]);
