// Archives whose bytes depend only on their files: zip(files, deflate), where `files` are [name, bytes], in this order, and
// `deflate(bytes)` promises them as a raw deflate stream. All have the earliest date of the format.
import zlib from 'node:zlib';

const DATE = (1 << 5) | 1; // 1 January 1980
const UTF8 = 1 << 11;

// The part that both headers of a file share.
function described({ bytes, packed }) {
  const part = Buffer.alloc(22);
  [20, UTF8, 8, 0, DATE].forEach((number, i) => part.writeUInt16LE(number, 2 * i));
  [zlib.crc32(bytes), packed.length, bytes.length].forEach((number, i) => part.writeUInt32LE(number, 10 + 4 * i));
  return part;
}

function numbers(...sizes) {
  const part = Buffer.alloc(sizes.reduce((sum, [size]) => sum + size, 0));
  let at = 0;
  for (const [size, value] of sizes) {
    part.writeUIntLE(value, at, size);
    at += size;
  }
  return part;
}

export async function zip(files, deflate) {
  const parts = [];
  const list = [];
  let at = 0;
  for (const [name, bytes] of files) {
    const file = { bytes, packed: Buffer.from(await deflate(bytes)) };
    const letters = Buffer.from(name);
    const header = Buffer.concat([numbers([4, 0x04034b50]), described(file), numbers([2, letters.length], [2, 0]), letters]);
    list.push(
      numbers([4, 0x02014b50], [2, 20]), described(file), numbers([2, letters.length], [2, 0], [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), letters,
    );
    parts.push(header, file.packed);
    at += header.length + file.packed.length;
  }
  const directory = Buffer.concat(list);
  const end = numbers([4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, directory.length], [4, at], [2, 0]);
  return Buffer.concat([...parts, directory, end]);
}
