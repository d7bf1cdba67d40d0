/** Holds what robots have worked of fields: figures and cells of each mission and field. */
import { api } from './api.js';
import { fullKey, scopeOf } from './identities.js';
import { streams } from './stream.js';

/** Maximum number of coverages; beyond it the one that was updated first is removed. A layer has at most 256 KiB. */
const MAX_COVERAGES = 64;
const MAX_CELLS = 1 << 18;

/**
 * What the robots of a mission have worked of a version of a field.
 *
 * @typedef {Object} Coverage
 * @property {string} key of tenant, service path, mission and field @property {string} field @property {string} fieldName @property {string|null} domain @property {string} mission
 * @property {string} device empty for all robots together @property {string} deviceType @property {number} time of the report, epoch ms
 * @property {Object=} figures `hectares`, `fieldHectares`, `share` (0 to 1), `overlap` and `gaps` (hectares), `perHour` (hectares), `left` (ms), `start`, `end` (epoch ms) @property {Layer=} layer
 */
/**
 * The cells of a coverage.
 *
 * @typedef {Object} Layer
 * @property {number[]} box west, south, east, north in degrees @property {number} columns @property {number} rows @property {Uint8Array} runs
 */

/** Parses a record of `data.coverage` or `data.coverage.layer`. @param {import('./stream.js').TopicRecord} record @returns {Coverage|null} null for other records */
export function readCoverage({ value, headers, time }) {
  const of = (name) => value?.[name]?.value;
  const isLayer = value?.type === 'Analytics:CoverageLayer';
  if ((value?.type !== 'Analytics:Coverage' && !isLayer) || typeof of('field') !== 'string') {
    return null;
  }
  const layer = isLayer ? readLayer(of) : undefined;
  const [field, mission, reported] = [of('field'), String(of('Mission') ?? ''), Number(of('time') ?? time)];
  return layer === null ? null : {
    key: fullKey(scopeOf(headers), mission, field), field, fieldName: String(of('fieldName') ?? field), domain: of('Domain') ?? null, mission, device: String(of('device') ?? ''), deviceType: String(of('deviceType') ?? ''), time: reported,
    ...(layer ? { layer } : { figures: {
      hectares: of('hectares'), fieldHectares: of('fieldHectares'), share: of('share'), overlap: of('overlapHectares'), gaps: of('gapHectares'), perHour: of('hectaresPerHour'), left: of('timeLeft'), start: of('startTime'), end: of('endTime'),
    } }),
  };
}

function readLayer(of) {
  const [box, columns, rows, runs] = ['box', 'columns', 'rows', 'runs'].map(of);
  const isValid = Array.isArray(box) && box.length === 4 && box.every(Number.isFinite) && columns > 0 && rows > 0 && columns * rows <= MAX_CELLS && typeof runs === 'string';
  try {
    return isValid ? { box, columns, rows, runs: Uint8Array.from(atob(runs), (each) => each.charCodeAt(0)) } : null;
  } catch {
    return null; // not Base64
  }
}

/**
 * Visits the cells of a layer that are not 0.
 *
 * @param {Layer} layer
 * @param {function(number, number, number, number)} visit code (1 covered, 2 covered again, 3 gap), row from the south, first column, number of columns
 */
export function visitRuns({ columns, rows, runs }, visit) {
  const all = columns * rows;
  for (let at = 0, cell = 0; at < runs.length && cell < all;) {
    let [number, factor] = [0, 1];
    do {
      number += (runs[at] & 127) * factor;
      factor *= 128;
    } while (runs[at++] > 127 && at < runs.length);
    const end = Math.min(all, cell + Math.floor(number / 4));
    while (cell < end) {
      const row = Math.floor(cell / columns);
      const next = Math.min(end, (row + 1) * columns);
      number % 4 && visit(number % 4, row, cell - row * columns, next - cell);
      cell = next;
    }
  }
}

/** `sorted` has the newest last. */
export class Coverages {
  constructor() {
    this.byKey = new Map();
    this.sorted = [];
  }

  /** Applies a record. Those of a single robot are ignored. @returns {boolean} whether it is news */
  apply(record) {
    const read = readCoverage(record);
    const existing = this.byKey.get(read?.key);
    const part = read?.layer ? 'layer' : 'figures';
    if (!read || read.device || existing?.[`${part}Time`] > read.time) {
      return false;
    }
    this.byKey.delete(read.key);
    this.byKey.set(read.key, { ...existing, ...read, time: Math.max(read.time, existing?.time ?? 0), [`${part}Time`]: read.time });
    this.byKey.size > MAX_COVERAGES && this.byKey.delete(this.byKey.keys().next().value);
    this.sorted = [...this.byKey.values()].sort((one, other) => one.time - other.time);
    return true;
  }
}

/** Follows what is worked: the newest records since a time, and each change. @param {string} topic of the figures; that of the cells ends with `.layer` @param {function(import('./stream.js').TopicRecord)} apply */
export function followCoverage(topic, from, apply) {
  const abort = new AbortController();
  const followed = [topic, `${topic}.layer`].map((each) => {
    const read = async () => {
      try {
        const { records } = await api.get(`/api/history/${encodeURIComponent(each)}?${new URLSearchParams({ from, newest: 'id' })}`, { signal: abort.signal });
        abort.signal.aborted || records.forEach(apply);
      } catch {
        // the next report brings it
      }
    };
    // the known state of such a topic may be all that was ever worked
    return streams.subscribe(each, { mode: 'latest', prime: false, createdLater: true }, { records: (records) => records.forEach(apply), state: (state) => state === 'open' && read() });
  });
  return { close: () => { abort.abort(); followed.forEach((each) => each.close()); } };
}
