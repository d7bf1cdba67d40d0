/** Holds the results of analytics in a period, and updates them: averages, encounters and stays. */
import { shortId } from '../../core/format.js';
import { differenceOf, fullKey, scopeOf, withDifference } from '../../core/identities.js';
import { store } from '../../core/store.js';
import { streams } from '../../core/stream.js';
import { encountersOf, historyIfAny, isBetween, readEncounter, union } from '../../timeline/moments.js';

/** How much earlier stays are read, since they may have begun before the period, ms. */
const MAX_STAY = 24 * 3_600_000;
const MAX_RESULTS = 5_000;

/**
 * An average of a window.
 *
 * @typedef {Object} Average
 * @property {string} field @property {string} service @property {string} servicePath of the devices
 * @property {string} mission of a replay, else empty @property {string} line the same for all averages of a field, scope and mission @property {string=} name of the line @property {number} start @property {number} end of the window, epoch ms @property {number} value °C
 * @property {number} plain mean including suspects @property {number} devices @property {string[]} suspects @property {string} quality
 */
/** @returns {Average|null} */
export function readAverage({ value, headers, time }, mission) {
  const of = (name) => value?.[name]?.value;
  if (value?.type !== 'Analytics:FieldTemperature' || typeof of('averageTemperature') !== 'number') {
    return null;
  }
  const [field, its] = [String(of('field')), scopeOf(headers)];
  return {
    field, ...its, mission, line: [field, its.service, its.servicePath, mission].join('\n'), start: of('windowStart') ?? time, end: of('windowEnd') ?? time, value: of('averageTemperature'), plain: of('plainMean'),
    devices: of('devices'), suspects: Array.isArray(of('suspects')) ? store.keysOf({ headers }, of('suspects').map(String), of('suspectTypes')) : [], quality: String(of('quality') ?? ''), epoch: Number(headers?.['replay-epoch'] ?? 0),
  };
}

/**
 * @returns {{id: string, identity: Object, device: string, field: string, fieldName: string, from: number, to: number|null}|null} `to` is null for a stay
 *     that continues
 */
function readStay({ value, headers }) {
  const of = (name) => value?.[name]?.value;
  if (value?.type !== 'Analytics:Presence' || typeof of('startTime') !== 'number') {
    return null;
  }
  const identity = { ...scopeOf(headers), type: String(of('deviceType') ?? ''), id: String(of('device')) };
  return {
    id: String(of('stay')), identity, device: store.identities.keyOf(identity.id, identity, identity.type), field: String(of('field')), fieldName: String(of('fieldName') ?? of('field')),
    mission: of('Mission') ?? null, from: of('startTime'), to: of('phase') === 'left' ? of('time') : null, epoch: Number(headers?.['replay-epoch'] ?? 0),
  };
}

function keyOf({ identity }) {
  return fullKey(identity, identity.type, identity.id);
}

export class Findings {
  /**
   * @param {{averages: Object[], encounters: Object[], stays: Object[]}} topics `topic` of each, and `mission` of each of a group of replays
   * @param {[number, number]} range epoch ms; later results are included
   * @param {{replay: boolean, group: string[], changed: function()}} options `group`: the missions that are replayed together, if they are several
   */
  constructor(topics, [from, to], { replay, group, changed }) {
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
    group.length > 0 && this.addBetween(group, from, to);
  }

  async load(topics, from) {
    const within = this.replay ? { from: 0 } : { from: Math.floor(from) };
    const followAll = async (all, range, apply) => Math.max(...await Promise.all(all.map(({ topic, mission }) => this.follow(topic, range, (record) => apply(record, mission)))));
    const [averages, encounters, stays] = await Promise.all([
      followAll(topics.averages, within, (record, mission) => this.applyAverage(record, mission)),
      followAll(topics.encounters, { ...within, newest: 'encounter' }, (record) => this.applyEncounter(record)),
      followAll(topics.stays, { from: Math.max(0, within.from - MAX_STAY), newest: 'stay' }, (record) => this.applyStay(record)),
    ]);
    this.since = { averages, encounters, stays: Math.max(from, stays) };
    this.loading = false;
    this.notify();
  }

  /** Adds the encounters between missions, which were found while they were recorded. */
  async addBetween(missions, from, to) {
    try {
      const { encounters } = await encountersOf(missions, from, to);
      this.encounters = union(this.encounters, encounters.filter(isBetween));
      this.notify();
    } catch (error) {
      this.error = Object.assign(error, { topic: 'data.collision' });
    }
  }

  /** Subscribes before reading the history: a record in both counts once. @returns {Promise<number>} the time since which the results are complete */
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
    let disconnected = false;
    this.streams.push(streams.subscribe(topic, { mode: 'all', prime: false, createdLater: true }, {
      records: (records) => { records.forEach(apply); this.changed(); },
      state: (state) => {
        state === 'open' && disconnected && read().then(() => this.notify());
        disconnected = state !== 'open' && (disconnected || state !== 'connecting');
      },
    }));
    return read();
  }

  notify() {
    this.abort.signal.aborted || this.changed();
  }

  applyAverage(record, mission = '') {
    const average = readAverage(record, mission);
    if (average && (this.replay || average.end >= this.from)) {
      const key = `${average.line}\n${average.start}`;
      const existing = this.averagesByWindow.get(key);
      if (!existing || existing.epoch <= average.epoch) {
        this.averagesByWindow.set(key, average);
      }
      if (this.averagesByWindow.size > MAX_RESULTS) {
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
      this.encounters = this.replay ? union([encounter], this.encounters) : [...this.encounters, encounter].slice(-MAX_RESULTS);
    }
  }

  applyStay(record) {
    const stay = readStay(record);
    if (stay) {
      // after a seek a stay has another id
      const id = this.replay ? `${keyOf(stay)} ${stay.field} ${stay.from}` : stay.id;
      const existing = this.staysById.get(id);
      if (!existing || existing.to === null || stay.to !== null) {
        this.staysById.set(id, stay);
      }
    }
  }

  /** The start of the oldest result; null without results. */
  get first() {
    const starts = [...[...this.averagesByWindow.values(), ...this.encounters].map((each) => each.start), ...[...this.staysById.values()].map((each) => each.from)];
    return starts.length ? starts.reduce((one, other) => Math.min(one, other)) : null;
  }

  /** The averages of a period in the order of their windows, with the names of their lines. */
  averages(from, to) {
    const found = [...this.averagesByWindow.values()].filter((each) => each.end >= from && each.start <= to).sort((one, other) => one.end - other.end);
    const lines = [...new Map(found.map((each) => [each.line, each])).values()];
    const names = new Map(lines.map((each) => [each.line,
      withDifference(store.fields.get(each.field)?.name ?? each.field, differenceOf(each, lines.filter(({ field }) => field === each.field)))]));
    return found.map((each) => ({ ...each, name: names.get(each.line) }));
  }

  encountersIn(from, to) {
    return this.encounters.filter((each) => each.end >= from && each.start <= to);
  }

  /** The stays of a period, with the names of their devices. */
  stays(from, to) {
    const found = [...this.staysById.values()].filter((each) => each.from <= to && (each.to ?? Infinity) >= from).sort((one, other) => one.from - other.from);
    const devices = [...new Map(found.map((each) => [keyOf(each), each.identity])).values()];
    const difference = (own) => differenceOf(own, devices.filter(({ id }) => id === own.id));
    return found.map((each) => ({ ...each, name: withDifference(shortId(each.identity.id), difference(each.identity)) }));
  }

  close() {
    this.abort.abort();
    this.streams.forEach((each) => each.close());
  }
}
