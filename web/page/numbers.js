// The numbers of the entry that the cursor is in, as sliders. They are found in the text's syntax tree, in either spelling, and written
// back into the text; their ranges come from the language server.
import { ensureSyntaxTree } from '@codemirror/language';
import { LSPPlugin } from '@codemirror/lsp-client';

const MOST = 24;
const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$/;

// ---- finding them: {label, at (of the name), from, to, value}

const textOf = (state, node) => state.sliceDoc(node.from, node.to);

function addYaml(state, node, label, at, found) {
  if (node.name === 'Literal') {
    const text = textOf(state, node);
    if (NUMBER.test(text)) found.push({ label, at, from: node.from, to: node.to, value: +text });
  } else if (node.name === 'FlowSequence' || node.name === 'BlockSequence') {
    let index = 0;
    for (let item = node.firstChild; item; item = item.nextSibling) {
      if (item.name !== 'Item') continue;
      for (let one = item.firstChild; one; one = one.nextSibling) addYaml(state, one, `${label}[${index}]`, at, found);
      index++;
    }
  } else if (node.name === 'BlockMapping' || node.name === 'FlowMapping') {
    for (let pair = node.firstChild; pair; pair = pair.nextSibling) {
      const key = pair.name === 'Pair' && pair.getChild('Key');
      if (!key) continue;
      const name = (label ? `${label}.` : '') + textOf(state, key);
      for (let one = key.nextSibling; one; one = one.nextSibling) addYaml(state, one, name, key.from, found);
    }
  }
}

function addXml(state, element, label, found) {
  const tag = element.firstChild;
  if (!tag || (tag.name !== 'OpenTag' && tag.name !== 'SelfClosingTag')) return;
  for (const attribute of tag.getChildren('Attribute')) {
    const name = attribute.getChild('AttributeName');
    const value = attribute.getChild('AttributeValue');
    if (!name || !value) continue;
    const text = textOf(state, value).slice(1, -1);
    if (NUMBER.test(text))
      found.push({ label: label + textOf(state, name), at: name.from, from: value.from + 1, to: value.to - 1, value: +text });
  }
  for (const child of element.getChildren('Element')) {
    const name = child.firstChild && child.firstChild.getChild('TagName');
    if (name) addXml(state, child, `${label}${textOf(state, name)} `, found);
  }
}

// The numbers of the entry at the cursor: the innermost map, list item or element that has numbers, but not the whole scene.
function findNumbers(state) {
  const tree = ensureSyntaxTree(state, state.doc.length, 50);
  if (!tree) return [];
  const { head } = state.selection.main;
  for (const side of [1, -1]) {
    for (let node = tree.resolveInner(head, side); node && node.parent; node = node.parent) {
      const found = [];
      const isWhole = !node.parent.parent || node.parent.name === 'Document';
      if (/^(Block|Flow)Mapping$/.test(node.name) && !isWhole) addYaml(state, node, '', node.from, found);
      if (node.name === 'Item' && node.firstChild && /Mapping$/.test(node.firstChild.name))
        for (let one = node.firstChild; one; one = one.nextSibling) addYaml(state, one, '', one.from, found);
      if (node.name === 'Pair' && node.parent.parent && node.parent.parent.name === 'Document') {
        const key = node.getChild('Key');
        for (let one = key && key.nextSibling; one; one = one.nextSibling)
          if (one.name !== 'Literal') addYaml(state, one, textOf(state, key), key.from, found);
      }
      if (node.name === 'Element' && !isWhole) addXml(state, node, '', found);
      if (found.length) return found.slice(0, MOST);
    }
  }
  return [];
}

// ---- their ranges

// The range in a hover's text about a number: 'from 0 to 1', 'greater than 0 and at most 360', '1 or more'.
function rangeOf(hover) {
  const limit = (expression) => {
    const found = expression.exec(hover);
    return found ? +found[1] : undefined;
  };
  const number = '(-?[0-9.]+(?:e[-+]?[0-9]+)?)';
  return {
    least: limit(new RegExp(`(?:from|greater than|at least) ${number}`)) ?? limit(new RegExp(`${number} or more`)),
    most: limit(new RegExp(`(?: to|less than|at most) ${number}`)),
  };
}

// The ends of a slider: the whole range if it is not much wider than the value, else a range around the value.
export function reach({ least = -Infinity, most = Infinity }, value, text) {
  const wide = 4 * Math.max(Math.abs(value), 0.25);
  const whole = Number.isInteger(value) && !text.includes('.') && Math.abs(value) >= 4;
  const low = least > -1000 && value - least <= wide ? least : value - wide;
  const high = most < 1000 && most - value <= wide * 4 ? most : value + wide;
  const step = 10 ** Math.floor(Math.log10((high - low) / 100));
  return { low: Math.max(low, least), high: Math.min(high, most), step: whole ? Math.max(1, step) : step };
}

async function hoverAt(client, view, at) {
  const plugin = LSPPlugin.get(view);
  if (!plugin || at > view.state.doc.length) return ''; // another text came meanwhile
  const params = { textDocument: { uri: plugin.uri }, position: plugin.toPosition(at) };
  const said = await client.request('textDocument/hover', params).catch(() => null);
  return said && said.contents ? said.contents.value || String(said.contents) : '';
}

// ---- the panel

export class Numbers {
  constructor({ panel, list, client }) {
    Object.assign(this, { panel, list, client });
    this.shown = [];
    this.timer = 0;
  }

  // After each change of text or cursor.
  update(editor) {
    clearTimeout(this.timer);
    const find = () => this.show(editor, findNumbers(editor.view.state));
    if (this.sliding) find();
    else this.timer = setTimeout(find, 120);
  }

  show(editor, found) {
    this.editor = editor;
    const same = found.length === this.shown.length && found.every((one, i) => one.label === this.shown[i].label);
    if (!same) {
      this.list.replaceChildren(...found.map((one, i) => this.row(one, i)));
      this.shown = found;
      this.askRanges(editor, found);
    } else {
      found.forEach((one, i) => Object.assign(this.shown[i], one));
    }
    this.panel.hidden = !found.length;
    this.shown.forEach((one) => this.fill(one));
  }

  row(one, index) {
    const row = document.createElement('label');
    const name = document.createElement('span');
    const value = document.createElement('output');
    const slider = document.createElement('input');
    name.textContent = one.label;
    slider.type = 'range';
    slider.oninput = () => this.slide(index, slider.value);
    slider.onchange = () => (this.sliding = false);
    row.append(name, slider, value);
    Object.assign(one, { slider, output: value });
    return row;
  }

  fill(one) {
    const text = this.editor.view.state.sliceDoc(one.from, one.to);
    const { low, high, step } = reach(one.range || {}, one.value, text);
    one.output.textContent = text;
    // A slider that is being moved keeps its ends; others follow their number.
    if (this.sliding) return;
    Object.assign(one.slider, { min: low, max: high, step });
    one.slider.value = one.value;
  }

  async askRanges(editor, found) {
    for (const one of found) {
      one.range = rangeOf(await hoverAt(this.client, editor.view, one.at));
      if (this.shown !== found) return;
      this.fill(one);
    }
  }

  slide(index, value) {
    const one = this.shown[index];
    this.sliding = true;
    const text = String(+(+value).toPrecision(6));
    this.editor.view.dispatch({ changes: { from: one.from, to: one.to, insert: text }, userEvent: 'input.slide' });
  }
}
