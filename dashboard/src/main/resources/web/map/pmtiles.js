/**
 * Reads tiles out of a PMTiles file of version 3, with requests of its parts:
 * https://github.com/protomaps/PMTiles/blob/main/spec/v3/spec.md
 */

const HEADER_BYTES = 127;
/** The header and the root directory lie within. */
const FIRST_BYTES = 16_384;
const LEAVES_KEPT = 64;
const MAX_LEVELS = 4;
const GZIP = 2;
const TYPES = { 2: 'image/png', 3: 'image/jpeg', 4: 'image/webp', 5: 'image/avif' };

/** @typedef {{tile: number, offset: number, length: number, run: number}} Entry of a directory; without a run it is of a further directory */

export class PmtilesFile {
  constructor(url) {
    this.url = url;
    this.leaves = new Map();
  }

  /** @returns {Promise<{minZoom: number, maxZoom: number, type: string, bounds: number[]}>} `bounds` are west, south, east, north in degrees */
  async header() {
    this.opened ??= this.open();
    return (await this.opened).header;
  }

  /** What the file says of itself, such as its `attribution`. */
  async metadata() {
    const { header } = await (this.opened ??= this.open());
    const [offset, length] = header.metadata;
    return length ? JSON.parse(new TextDecoder().decode(await this.part(offset, length, header.compression))) : {};
  }

  /** @returns {Promise<Blob|null>} the picture; null where the file has none */
  async tile(z, x, y, signal) {
    const { header, root } = await (this.opened ??= this.open());
    if (z < header.minZoom || z > header.maxZoom) {
      return null;
    }
    const id = tileId(z, x, y);
    let directory = root;
    for (let level = 0; level < MAX_LEVELS; level++) {
      const entry = find(directory, id);
      if (!entry) {
        return null;
      }
      if (entry.run > 0) {
        return new Blob([await this.part(header.tiles + entry.offset, entry.length, header.tileCompression, signal)], { type: header.type });
      }
      directory = await this.leaf(header, entry);
    }
    throw new Error(`${this.url} has directories in more than ${MAX_LEVELS} levels`);
  }

  async open() {
    const first = await this.part(0, FIRST_BYTES);
    const header = readHeader(first, this.url);
    const [offset, length] = header.root;
    const root = offset + length <= first.byteLength ? await unpacked(first.slice(offset, offset + length), header.compression) : await this.part(offset, length, header.compression);
    return { header, root: readDirectory(root) };
  }

  /** Those that were asked for last are kept. */
  leaf(header, { offset, length }) {
    const cached = this.leaves.get(offset) ?? this.part(header.leaves + offset, length, header.compression).then(readDirectory);
    this.leaves.delete(offset);
    this.leaves.set(offset, cached);
    cached.catch(() => this.leaves.delete(offset));
    if (this.leaves.size > LEAVES_KEPT) {
      this.leaves.delete(this.leaves.keys().next().value);
    }
    return cached;
  }

  /** @returns {Promise<ArrayBuffer>} */
  async part(offset, length, compression, signal) {
    const response = await fetch(this.url, { signal, headers: { Range: `bytes=${offset}-${offset + length - 1}` } });
    if (response.status !== 206) {
      throw new Error(`${this.url} answers ${response.status} where a part of it was asked for`);
    }
    return unpacked(await response.arrayBuffer(), compression);
  }
}

function readHeader(buffer, url) {
  const view = new DataView(buffer);
  const magic = buffer.byteLength >= HEADER_BYTES ? new TextDecoder().decode(buffer.slice(0, 7)) : '';
  if (magic !== 'PMTiles' || view.getUint8(7) !== 3) {
    throw new Error(`${url} is not a PMTiles file of version 3`);
  }
  const number = (at) => Number(view.getBigUint64(at, true));
  return {
    root: [number(8), number(16)],
    metadata: [number(24), number(32)],
    leaves: number(40),
    tiles: number(56),
    compression: view.getUint8(97),
    tileCompression: view.getUint8(98),
    type: TYPES[view.getUint8(99)] ?? '',
    minZoom: view.getUint8(100),
    maxZoom: view.getUint8(101),
    bounds: [102, 106, 110, 114].map((at) => view.getInt32(at, true) / 1e7),
  };
}

async function unpacked(buffer, compression) {
  return compression === GZIP ? new Response(new Blob([buffer]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer() : buffer;
}

/** Columns of varints: how many, ids as differences, runs, lengths, offsets, where 0 is the place behind the one before. @returns {Entry[]} */
function readDirectory(buffer) {
  const bytes = new Uint8Array(buffer);
  let at = 0;
  const varint = () => {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (!(byte & 128)) {
        return value;
      }
    }
  };
  const entries = Array.from({ length: varint() }, () => ({ tile: 0, offset: 0, length: 0, run: 0 }));
  let last = 0;
  entries.forEach((entry) => (entry.tile = last += varint()));
  entries.forEach((entry) => (entry.run = varint()));
  entries.forEach((entry) => (entry.length = varint()));
  entries.forEach((entry, index) => {
    const offset = varint();
    const before = entries[index - 1];
    entry.offset = offset === 0 && before ? before.offset + before.length : offset - 1;
  });
  return entries;
}

/** The last entry that is not behind the id, if the id is in its run or its directory. */
function find(entries, id) {
  let low = 0;
  let high = entries.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    entries[middle].tile <= id ? (low = middle + 1) : (high = middle);
  }
  const entry = entries[low - 1];
  return entry && (entry.run === 0 || id - entry.tile < entry.run) ? entry : null;
}

/** How many tiles come before it: those of all lower zooms, then along the Hilbert curve of its own. */
export function tileId(z, x, y) {
  const size = 2 ** z;
  let id = (size * size - 1) / 3;
  for (let side = size / 2; side >= 1; side /= 2) {
    const right = (x & side) > 0 ? 1 : 0;
    const low = (y & side) > 0 ? 1 : 0;
    id += side * side * ((3 * right) ^ low);
    if (low === 0) {
      [x, y] = right ? [size - 1 - y, size - 1 - x] : [y, x];
    }
  }
  return id;
}
