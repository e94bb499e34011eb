// A page of Markdown as HTML, by markdown-it: headings with the anchors that GitHub gives them, links of the site, colours of code,
// and the sections that the search finds.
import path from 'node:path';
import zlib from 'node:zlib';

const ALIASES = { sh: 'bash', elisp: 'lisp' };
// A text that reads a file cannot be opened alone.
const READS_A_FILE = /\.(obj|mtl|ply|stl|gltf|glb|png|jpe?g|webp|hdr|exr|ya?ml|xml)\b/i;

export const escapeHtml = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');

const plain = (inline) => inline.children.map((one) => (['text', 'code_inline'].includes(one.type) ? one.content : one.type === 'softbreak' ? ' ' : one.type === 'image' ? one.content : '')).join('');

// The fragment of a link that opens a text in the playground: what web/page/link.js reads.
export const playFragment = (name, text) => `#z=${encodeURIComponent(name)},${zlib.deflateRawSync(text, { level: 9 }).toString('base64url')}`;

export class Markdown {
  // `play`: {scenes}, the paths of the scenes that the playground has, or null without one.
  constructor({ MarkdownIt, Slugger, highlight, play }) {
    Object.assign(this, { Slugger, highlight, play });
    this.parser = new MarkdownIt({ html: true });
  }

  colours(text, language) {
    const name = ALIASES[language] || language;
    return name && this.highlight.getLanguage(name) ? this.highlight.highlight(text, { language: name }).value : escapeHtml(text);
  }

  code(text, language, after = '') {
    const label = language ? `${language} code` : 'text';
    return `<div class="code"><pre tabindex="0" role="group" aria-label="${label}"><code>${this.colours(text, language)}</code></pre>${after}</div>\n`;
  }

  // The fragment that opens this block, or null.
  playable(text, language, from, name) {
    if (!this.play || !['yaml', 'xml'].includes(language)) return null;
    const whole = language === 'yaml' ? /^glint: /m.test(text) : /^<Scene\b/m.test(text);
    const scene = from && from.startsWith('scenes/') ? from.slice('scenes/'.length) : null;
    if (scene && this.play.scenes.has(scene)) return whole && scene.endsWith(language) ? playFragment(scene, text) : `#${scene}`;
    if (!whole || READS_A_FILE.test(text)) return null;
    return playFragment(`${name}.glint.${language}`, text);
  }

  // {title, html, headings: [{level, id, text}], sections: [{id, title, text}]} of the file `source`; `link(href)` returns the site's
  // address for a link in the file, `playground` is the playground's address relative to the page.
  page(text, { source, link, playground, anchors = () => '' }) {
    const env = {};
    const tokens = this.parser.parse(text, env);
    const slugger = new this.Slugger();
    const headings = [];
    const sections = [{ id: '', title: '', text: '' }];
    const stem = path.basename(source, '.md').toLowerCase();
    let from = null;
    let blocks = 0;
    const out = [];
    tokens.forEach((token, i) => {
      if (token.type === 'heading_open') {
        const words = plain(tokens[i + 1]);
        const id = slugger.slug(words);
        const level = +token.tag.slice(1);
        headings.push({ level, id, text: words });
        token.attrSet('id', id);
        if (level > 1) sections.push({ id, title: words, text: '' });
        else sections[0].title = words;
      }
      if (token.type === 'inline') {
        if (tokens[i - 1].type !== 'heading_open') sections.at(-1).text += `${plain(token)} `;
        for (const child of token.children) {
          if (child.type === 'link_open') child.attrSet('href', link(child.attrGet('href')));
          if (child.type === 'image') {
            child.attrSet('src', link(child.attrGet('src')));
            child.attrSet('loading', 'lazy');
          }
        }
      }
      if (token.type === 'html_block') {
        from = /<!-- test: from (\S+)/.exec(token.content)?.[1] ?? (/^\s*<!-- test: /.test(token.content) ? from : null);
        token.content = token.content.replace(/<!--[\s\S]*?-->\s*/g, '');
      }
      if (token.type === 'fence') {
        const language = token.info.trim();
        const fragment = this.playable(token.content, language, from, `${stem}-${++blocks}`);
        const after = fragment ? `<p class="play"><a href="${escapeHtml(playground + fragment)}">Open in the playground</a></p>` : '';
        Object.assign(token, { type: 'html_block', content: this.code(token.content, language, after) });
      } else if (token.type === 'code_block') {
        Object.assign(token, { type: 'html_block', content: this.code(token.content, '') });
      }
      if (token.type !== 'html_block') from = null;
      if (token.type === 'heading_close') {
        const { level, id, text: words } = headings.at(-1);
        if (level > 1) out.push(hash(id, words));
        const more = anchors(id);
        out.push(token);
        if (more) out.push(raw(more));
        return;
      }
      if (token.type === 'table_open') out.push(raw('<div class="table" tabindex="0" role="group" aria-label="table">'));
      out.push(token);
      if (token.type === 'table_close') out.push(raw('</div>\n'));
    });
    const html = this.parser.renderer.render(out, this.parser.options, env);
    for (const section of sections) section.text = section.text.replace(/\s+/g, ' ').trim();
    return { title: headings[0]?.text ?? stem, html, headings, sections };
  }
}

// The HTML in a list of tokens.
function raw(content) {
  return { type: 'html_block', content, attrs: null, children: null, hidden: false, nesting: 0, tag: '', level: 0 };
}
function hash(id, words) {
  return raw(` <a class="hash" href="#${id}" aria-label="Link to: ${escapeHtml(words)}">#</a>`);
}
