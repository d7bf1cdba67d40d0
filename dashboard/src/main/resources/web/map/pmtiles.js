/** Reads tiles of a PMTiles file of version 3, of a server with range requests or of this computer: https://github.com/protomaps/PMTiles/blob/main/spec/v3/spec.md */

const HEADER_BYTES = 127;
/** The header and the root directory are within these. */
const FIRST_BYTES = 16_384;
const MAX_LEAVES = 64;
const MAX_LEVELS = 4;
const GZIP = 2;
const TYPES = { 2: 'image/png', 3: 'image/jpeg', 4: 'image/webp', 5: 'image/avif' };

/** @typedef {{tile: number, offset: number, length: number, run: number}} Entry of a directory; without a run it refers to a leaf directory */

export class PmtilesFile {
  /** @param {string|File} source URL, or a file */
  constructor(source) {
    this.source = source;
    this.url = source.name ?? source;
    this.leaves = new Map();
  }

  /** @returns {Promise<{minZoom: number, maxZoom: number, type: string, bounds: number[]}>} `bounds` are west, south, east, north in degrees */
  async header() {
    this.opened ??= this.open();
    return (await this.opened).header;
  }

  /** The metadata of the file, such as its `attribution`. */
  async metadata() {
    const { header } = await (this.opened ??= this.open());
    const [offset, length] = header.metadata;
    return length ? JSON.parse(new TextDecoder().decode(await this.range(offset, length, header.compression))) : {};
  }

  /** @returns {Promise<Blob|null>} the image; null if the file has none */
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
        return new Blob([await this.range(header.tiles + entry.offset, entry.length, header.tileCompression, signal)], { type: header.type });
      }
      directory = await this.leaf(header, entry);
    }
    throw new Error(`${this.url} has directories in more than ${MAX_LEVELS} levels`);
  }

  async open() {
    const first = await this.range(0, FIRST_BYTES);
    const header = readHeader(first, this.url);
    const [offset, length] = header.root;
    const root = offset + length <= first.byteLength ? await decompressed(first.slice(offset, offset + length), header.compression) : await this.range(offset, length, header.compression);
    return { header, root: readDirectory(root) };
  }

  /** Reads a leaf directory; caches the most recently used ones. */
  leaf(header, { offset, length }) {
    const cached = this.leaves.get(offset) ?? this.range(header.leaves + offset, length, header.compression).then(readDirectory);
    this.leaves.delete(offset);
    this.leaves.set(offset, cached);
    cached.catch(() => this.leaves.delete(offset));
    if (this.leaves.size > MAX_LEAVES) {
      this.leaves.delete(this.leaves.keys().next().value);
    }
    return cached;
  }

  /** @returns {Promise<ArrayBuffer>} */
  async range(offset, length, compression, signal) {
    if (this.source instanceof Blob) {
      return decompressed(await this.source.slice(offset, offset + length).arrayBuffer(), compression);
    }
    const response = await fetch(this.url, { signal, headers: { Range: `bytes=${offset}-${offset + length - 1}` } });
    if (response.status !== 206) {
      throw new Error(`${this.url} answers ${response.status} to a range request`);
    }
    return decompressed(await response.arrayBuffer(), compression);
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

async function decompressed(buffer, compression) {
  return compression === GZIP ? new Response(new Blob([buffer]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer() : buffer;
}

/**
 * Reads columns of varints: count, ids as differences, runs, lengths, offsets; offset 0 means directly after the previous entry. @returns {Entry[]}
 */
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
    const previous = entries[index - 1];
    entry.offset = offset === 0 && previous ? previous.offset + previous.length : offset - 1;
  });
  return entries;
}

/** The last entry that is not after the id, if its run contains the id or it refers to a directory. */
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

/** The id of a tile: the number of tiles before it, at all lower zooms and along the Hilbert curve of its own. */
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
