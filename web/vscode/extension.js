// The extension: it starts `glint lsp`, which runs as WebAssembly in a worker, when the first scene is opened, and shows pictures.
import * as vscode from 'vscode';
import { LanguageClient } from 'vscode-languageclient/browser';
import { EditorGlint } from './glint.js';
import { fromProtocol, toProtocol } from './places.js';
import { Previews } from './preview.js';

const LANGUAGES = ['yaml', 'xml'];
let client = null;
let glint = null;
let starting = null;

// Decides as the server does: by the name, or by the word in the text.
function isScene(document) {
  if (!LANGUAGES.includes(document.languageId) && !/\.glint\.[^./]+$/.test(document.uri.path)) return false;
  return /\.glint\.[^./]+$|\/\.glintrc\.yaml$/.test(document.uri.path) || document.getText().includes('glint');
}

export function activate(context) {
  const output = vscode.window.createOutputChannel('glint');
  const log = (line) => output.appendLine(line);
  const address = vscode.Uri.joinPath(context.extensionUri, 'dist', 'worker.js').toString(true);
  let compiled = null;
  const compile = () => {
    compiled = compiled || vscode.workspace.fs.readFile(vscode.Uri.joinPath(context.extensionUri, 'dist', 'glint.wasm')).then(WebAssembly.compile);
    return compiled;
  };

  async function start() {
    glint = new EditorGlint({ module: await compile(), address, texts: () => [], log });
    glint.onRestart = ended;
    const schemes = new Set(['file', 'untitled', ...(vscode.workspace.workspaceFolders || []).map(({ uri }) => uri.scheme)]);
    client = new LanguageClient(
      'glint', 'glint',
      {
        documentSelector: [...schemes].flatMap((scheme) => LANGUAGES.map((language) => ({ scheme, language }))),
        uriConverters: { code2Protocol: toProtocol, protocol2Code: fromProtocol },
        outputChannel: output,
      },
      glint.port(),
    );
    await client.start();
  }

  // A scene can need more memory, or a deeper stack, than a module has.
  async function ended(why) {
    log(`the language server has ended: ${why}`);
    const old = client;
    client = null;
    starting = null;
    glint.end();
    glint = null;
    if (old) await old.stop(0).catch(() => {});
    const again = 'Start Again';
    if ((await vscode.window.showErrorMessage(`glint has ended: ${why}`, again)) === again) begin();
  }

  function begin() {
    starting = starting || start().catch((error) => vscode.window.showErrorMessage(`glint cannot start: ${error.message}`));
    return starting;
  }
  const opened = (document) => {
    if (isScene(document)) begin();
  };

  const previews = new Previews({ context, compile, address, log });
  context.subscriptions.push(
    output, previews,
    vscode.workspace.onDidOpenTextDocument(opened),
    vscode.workspace.onDidChangeTextDocument(({ document }) => starting || opened(document)),
    vscode.commands.registerCommand('glint.showPreview', () => previews.show()),
  );
  vscode.workspace.textDocuments.forEach(opened);
  return { previews };
}

export async function deactivate() {
  if (client) await client.stop();
  if (glint) glint.end();
}
