// A scene's text in the fragment of an address, which browsers do not send: #z=PATH,TEXT, the text deflated and in base64url;
// or #PATH, a scene that ships.

const TEXT_MOST = 4 << 20; // bytes: what a link may unpack to

async function through(stream, bytes, most) {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > most) throw new Error('it holds more than 4 MB');
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

function toBase64(bytes) {
  let text = '';
  for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function fromBase64(text) {
  return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (char) => char.charCodeAt(0));
}

export async function encodeLink(path, text) {
  const bytes = await through(new CompressionStream('deflate-raw'), new TextEncoder().encode(text), Infinity);
  return `#z=${encodeURIComponent(path)},${toBase64(bytes)}`;
}

// {path, text}, {path}, or null if the fragment is empty; throws if it is damaged.
export async function decodeLink(fragment) {
  if (fragment.length < 2) return null;
  if (!fragment.startsWith('#z=')) return { path: decodeURIComponent(fragment.slice(1)) };
  const comma = fragment.indexOf(',');
  if (comma < 0) throw new Error('it has no text');
  const path = decodeURIComponent(fragment.slice(3, comma));
  if (!/\.(ya?ml|xml)$/.test(path) || path.startsWith('/') || path.split('/').includes('..')) throw new Error('it does not name a scene');
  const bytes = await through(new DecompressionStream('deflate-raw'), fromBase64(fragment.slice(comma + 1)), TEXT_MOST);
  return { path, text: new TextDecoder('utf-8', { fatal: true }).decode(bytes) };
}
