// A picture of a scene beside its text, coarse to fine, drawn by the reference tracer in a worker as in the page (web/page/picture.js).
import * as vscode from 'vscode';
import { Picture } from '../page/picture.js';
import { EditorGlint } from './glint.js';
import { pathOf } from './places.js';

const PAUSE_MS = 150; // after a key

class EditorPicture extends Picture {
  async show(png, { width, height }) {
    this.post({ png, width, height });
  }
}

class Preview {
  constructor({ document, module, address, log, context, gone }) {
    const path = pathOf(document.uri);
    const end = path.lastIndexOf('/');
    const name = path.slice(end + 1);
    this.name = name;
    const media = vscode.Uri.joinPath(context.extensionUri, 'dist');
    this.panel = vscode.window.createWebviewPanel('glint.preview', `Picture of ${name}`, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, {
      enableScripts: true, localResourceRoots: [media], retainContextWhenHidden: true,
    });
    const { webview } = this.panel;
    const at = (file) => webview.asWebviewUri(vscode.Uri.joinPath(media, file));
    webview.html = `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Picture</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src blob:; script-src ${webview.cspSource}; style-src ${webview.cspSource}">
<link rel="stylesheet" href="${at('view.css')}"></head>
<body><img id="picture" alt="The picture of ${name.replace(/[&<"]/g, (c) => `&#${c.charCodeAt(0)};`)}" hidden>
<p><label id="cameras" hidden>Camera <select id="camera"></select></label> <span id="state" role="status">Drawing</span></p>
<script src="${at('view.js')}"></script></body></html>`;
    this.glint = new EditorGlint({ module, address, texts: () => this.texts(), log, folder: path.slice(0, end) || '/', keeps: true });
    this.picture = new EditorPicture({ glint: this.glint, canvas: null, told: (what) => this.told(what), seen: (scene) => this.seen(scene) });
    this.picture.post = (message) => webview.postMessage(message);
    this.shown = null; // what the view says that it shows: {width, height, whole}
    this.subscriptions = [
      this.panel.onDidDispose(() => {
        this.dispose();
        gone();
      }),
      webview.onDidReceiveMessage((message) => this.take(message)),
      vscode.workspace.onDidChangeTextDocument((event) => this.changed(event.document)),
      // Unsaved text is gone.
      vscode.workspace.onDidCloseTextDocument((document) => {
        this.glint.put({}, [pathOf(document.uri)]);
        this.draw();
      }),
    ];
    const watcher = vscode.workspace.createFileSystemWatcher('**/*');
    const touched = (uri) => this.touched(uri);
    this.subscriptions.push(watcher, watcher.onDidChange(touched), watcher.onDidCreate(touched), watcher.onDidDelete(touched));
  }

  // Documents as they are in the editor, saved or not.
  texts() {
    return vscode.workspace.textDocuments.filter((one) => ['yaml', 'xml'].includes(one.languageId)).map((one) => [pathOf(one.uri), one.getText()]);
  }

  draw() {
    clearTimeout(this.soon);
    this.soon = setTimeout(() => this.picture.draw(this.name), PAUSE_MS);
  }
  changed(document) {
    if (!['yaml', 'xml'].includes(document.languageId)) return;
    this.glint.put({ [pathOf(document.uri)]: document.getText() });
    this.draw();
  }
  touched(uri) {
    const path = pathOf(uri);
    if (!this.glint.knows(path) || this.texts().some(([open]) => open === path)) return; // the text of open documents is known
    this.glint.put({}, [path]);
    this.draw();
  }

  told({ failed, part, whole, ms, samples }) {
    if (failed !== undefined) this.panel.webview.postMessage({ failed: failed.split('\n')[0] || 'The scene has errors' });
    else this.panel.webview.postMessage({ part, whole, ms, samples });
  }
  seen({ cameras }) {
    this.panel.webview.postMessage({ cameras, camera: this.picture.camera });
  }
  take(message) {
    if (message.ready) this.draw();
    if (message.shown) this.shown = message.shown;
    if (message.camera !== undefined) {
      this.picture.camera = message.camera;
      this.draw();
    }
  }

  dispose() {
    clearTimeout(this.soon);
    for (const one of this.subscriptions) one.dispose();
    this.glint.end();
  }
}

// One for each document.
export class Previews {
  constructor(made) {
    this.made = made;
    this.open = new Map();
  }
  async show() {
    const document = vscode.window.activeTextEditor?.document;
    if (!document || !['yaml', 'xml'].includes(document.languageId)) {
      vscode.window.showInformationMessage('Open a scene first: its picture is shown beside it.');
      return;
    }
    const key = document.uri.toString();
    const there = this.open.get(key);
    if (there) {
      there.panel.reveal(undefined, true);
      return;
    }
    const module = await this.made.compile();
    this.open.set(key, new Preview({ ...this.made, document, module, gone: () => this.open.delete(key) }));
  }
  // What views show, by document.
  shown(uri) {
    return this.open.get(uri.toString())?.shown || null;
  }
  // The file of the whole picture, once there is one.
  whole(uri) {
    return this.open.get(uri.toString())?.picture.whole || null;
  }
  dispose() {
    for (const one of [...this.open.values()]) one.panel.dispose();
  }
}
