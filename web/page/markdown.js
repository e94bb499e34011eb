// What `glint lsp` writes in Markdown (lsp/markdown.h), as HTML: paragraphs, fenced code, **strong**, `code`, and characters that a
// backslash keeps. It replaces `marked` in the language client, of whose 38 KB nothing else would be used. Everything else is plain text: a
// scene may come from a link.

const escape = (text) => text.replace(/[&<>"]/g, (char) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[char]);

function inline(text) {
  let html = '';
  for (const [part] of text.matchAll(/\\[!-/:-@[-`{-~]|`[^`]*`|\*\*(?:[^*\\]|\\.)+\*\*|\*(?:[^*\\]|\\.)+\*|[^\\`*]+|[\\`*]/g)) {
    if (part.length > 1 && part[0] === '\\') html += escape(part[1]);
    else if (part.length > 2 && part[0] === '`') html += `<code>${escape(part.slice(1, -1))}</code>`;
    else if (part.length > 4 && part.startsWith('**')) html += `<strong>${inline(part.slice(2, -2))}</strong>`;
    else if (part.length > 2 && part[0] === '*') html += `<em>${inline(part.slice(1, -1))}</em>`;
    else html += escape(part);
  }
  return html;
}

export function toHtml(text) {
  const parts = [];
  let paragraph = [];
  let code = null;
  let fence = '';
  const end = () => {
    if (paragraph.length) parts.push(`<p>${inline(paragraph.join('\n'))}</p>`);
    paragraph = [];
  };
  for (const line of text.split('\n')) {
    const [mark] = /^```+/.exec(line) || [''];
    if (code ? mark === fence && line === fence : mark) {
      end();
      if (code) parts.push(`<pre><code>${escape(code.join('\n'))}</code></pre>`);
      code = code ? null : [];
      fence = mark;
    } else if (code) code.push(line);
    else if (line.trim()) paragraph.push(line);
    else end();
  }
  end();
  if (code) parts.push(`<pre><code>${escape(code.join('\n'))}</code></pre>`);
  return parts.join('');
}

// As the language client calls it.
export class Marked {
  parse(text) {
    return toHtml(text);
  }
}
