// An editor of scenes: CodeMirror, with what `glint lsp` knows.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap } from '@codemirror/commands';
import { xmlLanguage } from '@codemirror/lang-xml';
import { yaml } from '@codemirror/lang-yaml';
import { bracketMatching, indentOnInput, syntaxHighlighting } from '@codemirror/language';
import { forEachDiagnostic, lintGutter, lintKeymap, setDiagnostics } from '@codemirror/lint';
import {
  LSPClient, LSPPlugin, findReferencesKeymap, formatDocument, formatKeymap, hoverTooltips, jumpToDefinitionKeymap, renameKeymap,
  serverCompletion,
} from '@codemirror/lsp-client';
import { Annotation, EditorState } from '@codemirror/state';
import {
  EditorView, drawSelection, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, keymap, lineNumbers,
} from '@codemirror/view';
import { classHighlighter } from '@lezer/highlight';

export { formatDocument };

const FOLDER = 'file:///scene/';
export const uriOf = (path) => FOLDER + encodeURI(path);
export const isXml = (path) => path.endsWith('.xml');
const isScene = (path) => /\.(ya?ml|xml)$/.test(path);

// ---- findings, with their fixes

const SEVERITIES = [, 'error', 'warning', 'info', 'hint'];
const keyOf = ({ code, range }) => JSON.stringify([code, range]);

function apply(view, mapping, uri, edits) {
  const changes = edits.map(({ range, newText }) => ({
    from: mapping.mapPosition(uri, range.start, 1),
    to: Math.max(mapping.mapPosition(uri, range.start, 1), mapping.mapPosition(uri, range.end, -1)),
    insert: newText,
  }));
  view.dispatch({ changes, userEvent: 'input.fix', scrollIntoView: true });
}

const mappings = new WeakMap(); // by view: from the text that was judged last to the current text

function show(view, mapping, params, actions) {
  const { uri } = params;
  const found = params.diagnostics.map((one) => ({
    from: mapping.mapPosition(uri, one.range.start),
    to: mapping.mapPosition(uri, one.range.end),
    severity: SEVERITIES[one.severity] || 'error',
    source: one.code,
    message: one.message,
    actions: (actions.get(keyOf(one)) || []).map(({ title, edit }) => ({
      name: title,
      apply: (where) => apply(where, mapping, uri, edit.changes[uri]),
    })),
  }));
  view.dispatch(setDiagnostics(view.state, found));
}

function askActions(client, view, uri, only) {
  const end = LSPPlugin.get(view).toPosition(view.state.doc.length);
  const context = { diagnostics: [], ...(only ? { only: [only] } : {}) };
  return client.request('textDocument/codeAction', { textDocument: { uri }, range: { start: { line: 0, character: 0 }, end }, context });
}

function publish(client, params) {
  const file = client.workspace.getFile(params.uri);
  const view = file && file.getView();
  if (!view || (params.version != null && params.version !== file.version)) return true;
  if (mappings.has(view)) mappings.get(view).destroy();
  const mapping = client.workspaceMapping();
  mappings.set(view, mapping);
  show(view, mapping, params, new Map());
  if (!params.diagnostics.length) return true;
  askActions(client, view, params.uri, 'quickfix').then((list) => {
    if (mappings.get(view) !== mapping) return; // a newer text was judged
    const actions = new Map();
    for (const action of list)
      for (const one of action.diagnostics || []) actions.set(keyOf(one), [...(actions.get(keyOf(one)) || []), action]);
    if (actions.size) show(view, mapping, params, actions);
  }, () => {});
  return true;
}

// The fix of the finding at the cursor.
function fixHere(view) {
  const { head } = view.state.selection.main;
  let found = null;
  forEachDiagnostic(view.state, (one, from, to) => {
    if (!found && one.actions && one.actions.length && from <= head && head <= to) found = [one.actions[0], from, to];
  });
  if (found) found[0].apply(view, found[1], found[2]);
  return !!found;
}

export function connect(glint) {
  const client = new LSPClient({
    rootUri: FOLDER,
    timeout: 60000,
    notificationHandlers: { 'textDocument/publishDiagnostics': publish },
    extensions: [
      serverCompletion({ override: true }), hoverTooltips(),
      keymap.of([...formatKeymap, ...renameKeymap, ...jumpToDefinitionKeymap, ...findReferencesKeymap]),
    ],
  });
  return client.connect(glint);
}

// ---- the editor

const theme = EditorView.theme({
  '&': { height: '100%', color: 'var(--text)', backgroundColor: 'var(--paper)', fontSize: '13px' },
  '.cm-content': { caretColor: 'var(--text)', fontFamily: 'var(--mono)' },
  '.cm-cursor': { borderLeftColor: 'var(--text)' },
  '.cm-gutters': { backgroundColor: 'var(--paper)', color: 'var(--faint)', border: 'none' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'var(--line)' },
  '&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground': { background: 'var(--selection) !important' },
  '.cm-tooltip, .cm-panels': { backgroundColor: 'var(--panel)', color: 'var(--text)', border: '1px solid var(--edge)' },
  '.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--on-accent)' },
  '.cm-tooltip-lint, .cm-lsp-documentation': { maxWidth: '34em' },
  '.cm-diagnosticAction': { backgroundColor: 'var(--accent)', color: 'var(--on-accent)' },
});

const made = Annotation.define(); // marks a change that was not typed

export class Editor {
  // `changed(text)` and `moved()` are called for keys, not for `open`.
  constructor({ parent, label, client, changed, moved }) {
    this.client = client;
    this.label = label;
    this.changed = changed;
    this.moved = moved;
    this.locked = false;
    this.view = new EditorView({ parent, state: this.state('', '') });
  }

  state(path, text) {
    return EditorState.create({
      doc: text,
      extensions: [
        EditorState.readOnly.of(this.locked),
        lineNumbers(), highlightActiveLineGutter(), highlightSpecialChars(), history(), drawSelection(), indentOnInput(),
        syntaxHighlighting(classHighlighter), bracketMatching(), closeBrackets(), autocompletion(), highlightActiveLine(),
        lintGutter(), theme, EditorView.lineWrapping,
        keymap.of([
          { key: 'Mod-.', run: fixHere }, ...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap,
          ...completionKeymap, ...lintKeymap,
        ]),
        EditorView.contentAttributes.of({ 'aria-label': this.label, spellcheck: 'false', tabindex: '0' }),
        isXml(path) ? xmlLanguage : isScene(path) ? yaml() : [],
        isScene(path) ? this.client.plugin(uriOf(path), isXml(path) ? 'xml' : 'yaml') : [],
        EditorView.updateListener.of((update) => {
          if (update.docChanged) {
            this.client.sync(); // at once: by itself the client would wait until no key is pressed for half a second
            if (!update.transactions.some((one) => one.annotation(made))) this.changed(this.text());
          }
          if (update.selectionSet || update.docChanged) this.moved();
        }),
      ],
    });
  }

  get path() {
    return this.opened;
  }
  text() {
    return this.view.state.doc.toString();
  }
  // Another file, with a history of its own. `locked`: keys do not change it.
  open(path, text, locked = false) {
    this.locked = locked;
    this.opened = path;
    this.view.setState(this.state(path, text));
  }
  // The same file with another text, made by the program: it was not typed, but can be undone.
  replace(text) {
    const old = this.text();
    if (old === text) return;
    let from = 0;
    while (from < old.length && from < text.length && old[from] === text[from]) from++;
    let end = 0;
    while (end < old.length - from && end < text.length - from && old[old.length - 1 - end] === text[text.length - 1 - end]) end++;
    this.view.dispatch({ changes: { from, to: old.length - end, insert: text.slice(from, text.length - end) }, annotations: made.of(true) });
  }
  // Line and column from 1, the column in code points as glint counts it.
  go(line, column, focus = true) {
    const { doc } = this.view.state;
    const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
    const place = at.from + [...at.text].slice(0, column - 1).join('').length;
    this.view.dispatch({ selection: { anchor: place }, effects: EditorView.scrollIntoView(place, { y: 'center' }) });
    if (focus) this.view.focus();
  }
  async fixAll() {
    const { view, client } = this;
    const uri = uriOf(this.path);
    client.sync();
    const mapping = client.workspaceMapping();
    const all = (await askActions(client, view, uri, 'source.fixAll')).find((one) => one.kind === 'source.fixAll.glint');
    if (all) apply(view, mapping, uri, all.edit.changes[uri]);
    mapping.destroy();
    return !!all;
  }
  format() {
    this.client.sync();
    return formatDocument(this.view);
  }
}
