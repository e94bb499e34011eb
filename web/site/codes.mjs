// A page for each code of a message: its text in docs/codes.md (made from the table that `glint explain` reads), its rule in docs/lint.md,
// and the cases of tests/invalid with glint's exact messages.
import fs from 'node:fs';
import path from 'node:path';

const LINES_MOST = 40; // of a case that is shown
const CASES_MOST = 3;

// [{code, text}] of the sections '### E206'.
export function codesOf(markdown) {
  const parts = markdown.split(/^### ([EWN]\d+)$/m);
  const found = [];
  for (let i = 1; i < parts.length; i += 2) found.push({ code: parts[i], text: parts[i + 1].split(/^## /m)[0].trim() });
  return found;
}

function textOf(file) {
  try {
    const text = new TextDecoder('utf-8', { fatal: true }).decode(fs.readFileSync(file));
    return /[\u0000-\u0008\u000b-\u001f\u007f]/.test(text) || text.split('\n').length > LINES_MOST || text.split('\n').some((line) => line.length > 200) ? null : text;
  } catch {
    return null; // a file that is missing or not UTF-8 cannot be shown
  }
}

// The cases of a code that a page can show: [{name, language, text, said}], whose messages name that code.
export function casesOf(source, code) {
  const folder = path.join(source, 'tests/invalid');
  const found = [];
  for (const name of fs.readdirSync(folder).filter((one) => one.startsWith(`${code.toLowerCase()}_`)).sort()) {
    const said = textOf(path.join(folder, name, 'expected.txt'));
    if (!said || !said.includes(`[${code}]`)) continue;
    for (const language of ['yaml', 'xml']) {
      const text = textOf(path.join(folder, name, `case.${language}`));
      const options = textOf(path.join(folder, name, 'options'));
      if (text !== null && found.length < CASES_MOST) found.push({ name, language, text, said, options: options ? options.trim() : '' });
    }
  }
  return found;
}

// The page as Markdown, beside docs/codes.md.
export function codePage({ code, text }, rule, cases) {
  const [, severity, title, rest] = /^\*\*(\w+): (.*?)\.\*\*([\s\S]*)$/.exec(text) || [null, '', code, text];
  const parts = [`# ${code}: ${title}`, `*${severity}* · \`glint explain ${code}\` · [all codes](codes.md)`, rest.trim()];
  if (rule) parts.push(`The rule, with a wrong and a right scene: [${rule.text}](lint.md#${rule.id}).`);
  if (cases.length) parts.push('## Examples');
  for (const one of cases) {
    const fence = '`'.repeat(Math.max(3, ...[...`${one.text}${one.said}`.matchAll(/`+/g)].map(([ticks]) => ticks.length + 1)));
    parts.push(`In ${one.language.toUpperCase()}${one.options ? `, with \`${one.options.replaceAll('\n', ' ')}\`` : ''}:`);
    parts.push(`${fence}${one.language}\n${one.text.replace(/\n?$/, '\n')}${fence}`, `glint says:`, `${fence}\n${one.said.replace(/\n?$/, '\n')}${fence}`);
  }
  return { title: `${code}: ${title}`, markdown: `${parts.filter(Boolean).join('\n\n')}\n` };
}
