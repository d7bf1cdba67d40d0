/** Measures how long reports take from hop to hop, by the times in their headers. */

const WINDOW_MILLIS = 60_000;
const MAX_SAMPLES = 4_000;

/** Hops: from the device to the NGSI source, from there to ingest, from there to this page. */
const HOPS = ['device', 'source', 'page'];

export class HopDelays {
  constructor() {
    this.samples = [];
  }

  /** @param {import('../../core/stream.js').TopicRecord} record of a domain's topic @param {number} now epoch ms */
  add(record, now) {
    const of = (name) => Number(record.headers[name]);
    const [device, source, ingest] = [of('ts-device'), of('ts-source'), of('ts-ingest')];
    if (record.kind === 'event' && device > 0 && source > 0 && ingest > 0) {
      this.samples.push({ at: now, delays: [source - device, ingest - source, now - ingest] });
      this.samples.length > MAX_SAMPLES && this.samples.shift();
    }
  }

  /** @returns {{name: string, p50: number, p95: number, p99: number}[]|null} ms, of the last minute; the last entry covers all hops together */
  summary(now) {
    this.samples = this.samples.filter((each) => now - each.at < WINDOW_MILLIS);
    if (this.samples.length < 5) {
      return null;
    }
    const hops = HOPS.map((name, index) => quantiles(name, this.samples.map((each) => each.delays[index])));
    return [...hops, quantiles('all', this.samples.map((each) => each.delays[0] + each.delays[1] + each.delays[2]))];
  }

  get count() {
    return this.samples.length;
  }
}

function quantiles(name, values) {
  const sorted = values.map((each) => Math.max(0, each)).sort((a, b) => a - b);
  const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
  return { name, p50: at(0.5), p95: at(0.95), p99: at(0.99) };
}
