/** What analytics found in a stretch of time: averages, encounters and stays, kept up to date. */
import { shortId } from '../../core/format.js';
import { store } from '../../core/store.js';
import { streams } from '../../core/stream.js';
import { historyIfAny, readEncounter, union } from '../../timeline/moments.js';

/** Stays that began so long before are looked for, ms. */
const STAYED_BEFORE = 24 * 3_600_000;
const MOST = 5_000;

/**
 * @typedef {Object} Average
 * @property {string} field @property {number} start @property {number} end of the window, epoch ms @property {number} value °C
 * @property {number} plain mean of all, suspects too @property {number} devices @property {string[]} suspects @property {string} quality
 */
/** @returns {Average|null} */
export function readAverage({ value, headers, time }) {
  const of = (name) => value?.[name]?.value;
  if (value?.type !== 'Analytics:FieldTemperature' || typeof of('averageTemperature') !== 'number') {
    return null;
  }
  return {
    field: String(of('field')), start: of('windowStart') ?? time, end: of('windowEnd') ?? time, value: of('averageTemperature'), plain: of('plainMean'),
    devices: of('devices'), suspects: Array.isArray(of('suspects')) ? store.keysOf({ headers }, of('suspects').map(String), of('suspectTypes')) : [], quality: String(of('quality') ?? ''), epoch: Number(headers?.['replay-epoch'] ?? 0),
  };
}

/** @returns {{id: string, device: string, name: string, field: string, fieldName: string, from: number, to: number|null}|null} `to` null where it goes on */
export function readStay({ value, headers }) {
  const of = (name) => value?.[name]?.value;
  if (value?.type !== 'Analytics:Presence' || typeof of('startTime') !== 'number') {
    return null;
  }
  return {
    id: String(of('stay')), device: store.keysOf({ headers }, [String(of('device'))], [of('deviceType')])[0], name: shortId(of('device')), field: String(of('field')), fieldName: String(of('fieldName') ?? of('field')),
    mission: of('Mission') ?? null, from: of('startTime'), to: of('phase') === 'left' ? of('time') : null, epoch: Number(headers?.['replay-epoch'] ?? 0),
  };
}

export class Findings {
  /**
   * @param {{averages: string, encounters: string, stays: string}} topics
   * @param {[number, number]} range epoch ms; what comes later is taken too
   * @param {{replay: boolean, changed: function()}} how
   */
  constructor(topics, [from], { replay, changed }) {
    this.replay = replay;
    this.changed = changed;
    this.from = from;
    this.loading = true;
    this.error = null;
    this.since = { averages: from, encounters: from, stays: from };
    this.averagesByWindow = new Map();
    this.encounters = [];
    this.staysById = new Map();
    this.abort = new AbortController();
    this.streams = [];
    this.load(topics, from);
  }

  async load(topics, from) {
    const within = this.replay ? { from: 0 } : { from: Math.floor(from) };
    const [averages, encounters, stays] = await Promise.all([
      this.follow(topics.averages, within, (record) => this.applyAverage(record)),
      this.follow(topics.encounters, { ...within, newest: 'encounter' }, (record) => this.applyEncounter(record)),
      this.follow(topics.stays, { from: Math.max(0, within.from - STAYED_BEFORE), newest: 'stay' }, (record) => this.applyStay(record)),
    ]);
    this.since = { averages, encounters, stays: Math.max(from, stays) };
    this.loading = false;
    this.notify();
  }

  /** The stream first: what comes while the history is read lies in both, and counts once. @returns {Promise<number>} since when it is whole */
  follow(topic, range, apply) {
    const read = async () => {
      try {
        const { records, since } = await historyIfAny(topic, range, { signal: this.abort.signal });
        records.forEach(apply);
        this.error = this.error?.topic === topic ? null : this.error;
        return since;
      } catch (error) {
        this.error = Object.assign(error, { topic });
        return this.from;
      }
    };
    let away = false;
    this.streams.push(streams.subscribe(topic, { mode: 'all', prime: false }, {
      records: (records) => { records.forEach(apply); this.changed(); },
      state: (state) => {
        state === 'open' && away && read().then(() => this.notify());
        away = state !== 'open' && (away || state !== 'connecting');
      },
    }));
    return read();
  }

  notify() {
    this.abort.signal.aborted || this.changed();
  }

  applyAverage(record) {
    const average = readAverage(record);
    if (average && (this.replay || average.end >= this.from)) {
      const key = `${average.field} ${average.start}`;
      const existing = this.averagesByWindow.get(key);
      if (!existing || existing.epoch <= average.epoch) {
        this.averagesByWindow.set(key, average);
      }
      if (this.averagesByWindow.size > MOST) {
        this.averagesByWindow.delete(this.averagesByWindow.keys().next().value);
      }
    }
  }

  applyEncounter(record) {
    const encounter = readEncounter(record);
    if (!encounter) {
      return;
    }
    const index = this.encounters.findIndex((each) => each.id === encounter.id);
    if (index >= 0) {
      this.encounters[index].end <= encounter.end && (this.encounters[index] = encounter);
    } else {
      this.encounters = this.replay ? union([encounter], this.encounters) : [...this.encounters, encounter].slice(-MOST);
    }
  }

  applyStay(record) {
    const stay = readStay(record);
    if (stay) {
      // a jump begins stays anew, under another id
      const id = this.replay ? `${stay.device} ${stay.field} ${stay.from}` : stay.id;
      const existing = this.staysById.get(id);
      if (!existing || existing.to === null || stay.to !== null) {
        this.staysById.set(id, stay);
      }
    }
  }

  /** When the oldest that is known began; null where nothing is. */
  get first() {
    const starts = [...[...this.averagesByWindow.values(), ...this.encounters].map((each) => each.start), ...[...this.staysById.values()].map((each) => each.from)];
    return starts.length ? starts.reduce((one, other) => Math.min(one, other)) : null;
  }

  /** In the order of their windows. */
  averages(from, to) {
    return [...this.averagesByWindow.values()].filter((each) => each.end >= from && each.start <= to).sort((one, other) => one.end - other.end);
  }

  encountersIn(from, to) {
    return this.encounters.filter((each) => each.end >= from && each.start <= to);
  }

  stays(from, to) {
    return [...this.staysById.values()].filter((each) => each.from <= to && (each.to ?? Infinity) >= from).sort((one, other) => one.from - other.from);
  }

  close() {
    this.abort.abort();
    this.streams.forEach((each) => each.close());
  }
}
