/** Reads encounters and markers of missions. */
import { api } from '../core/api.js';
import { exists } from '../core/existing.js';
import { shortId } from '../core/format.js';
import { withDifference } from '../core/identities.js';
import { store } from '../core/store.js';

/** Encounters of a pair whose starts differ by at most this are the same one, found twice, ms. */
const SAME_START = 2_000;

/**
 * An encounter of two devices.
 *
 * @typedef {Object} Encounter
 * @property {string} id @property {string} a @property {string} b keys of the devices in the page @property {string} phase
 * @property {number} start @property {number} end epoch ms; of an ongoing encounter the time of its newest record
 * @property {number} closest meters @property {string[]} missions @property {number} epoch of a replay @property {[number, number]|null} at
 */

/**
 * Parses an encounter from its newest record; null for predictions and other records.
 *
 * @param {import('../core/stream.js').TopicRecord} record of `data.collision`, or of a replay's results
 * @returns {Encounter|null}
 */
export function readEncounter(record) {
  const of = (name) => record.value?.[name]?.value;
  const phase = of('phase');
  if (record.value?.type !== 'Analytics:Collision' || !['started', 'ongoing', 'ended', 'crossed'].includes(phase)) {
    return null;
  }
  const ahead = Number(record.headers?.['replay-offset'] ?? 0);
  const ids = [String(of('Device1_ID')), String(of('Device2_ID'))];
  const [a, b] = store.keysOfPair(record);
  const end = Number(of('time') ?? record.time) - ahead;
  const [lon, lat] = [of('Device1_longitude'), of('Device1_latitude')];
  return {
    id: String(of('encounter') ?? `${a}-${b}-${record.time}`), a, b, phase, pair: [a, b].map((key, i) => withDifference(shortId(ids[i]), store.entities.get(key)?.difference)).join(' – '),
    start: Math.min(end, Number(of('startTime') ?? end) - ahead), end,
    closest: Number(of('minDistance') ?? of('dcpa') ?? of('distance')),
    missions: [of('Device1_Mission'), of('Device2_Mission')].filter((each) => typeof each === 'string'),
    epoch: Number(record.headers?.['replay-epoch'] ?? 0),
    at: typeof lon === 'number' && typeof lat === 'number' ? [lon, lat] : null,
  };
}

/**
 * Reads the records of a topic in a period.
 *
 * @param {{from: number, to: number=, newest: string=, limit: number=}} range epoch ms; `newest` names an attribute of which only the newest record
 *     per value is returned
 * @returns {Promise<{records: import('../core/stream.js').TopicRecord[], since: number}>} complete from `since` on
 */
export async function history(topic, range, options) {
  const present = Object.entries(range).filter(([, value]) => value !== undefined);
  return api.get(`/api/history/${encodeURIComponent(topic)}?${new URLSearchParams(present)}`, options);
}

/** Like {@link history}; empty if the topic does not exist, since some topics are created with their first record. */
export async function historyIfAny(topic, range, options) {
  return (await exists(topic)) ? history(topic, range, options) : { records: [], since: range.from };
}

/** Merges two lists; of an encounter in both, that of the first list is used. */
export function union(encounters, others) {
  return [...encounters, ...others.filter((other) =>
    !encounters.some((each) => each.a === other.a && each.b === other.b && Math.abs(each.start - other.start) <= SAME_START))]
    .sort((one, other) => one.start - other.start);
}

/** Encounters found live while a mission was recorded, as far as the topic retains them. */
export async function encountersOf(missions, from, to) {
  const { records, since } = await historyIfAny('data.collision', { from: Math.floor(from), to: Math.ceil(to) + 1, newest: 'encounter' });
  const encounters = records.map(readEncounter).filter((each) => each && each.missions.some((mission) => missions.includes(mission)));
  return { encounters: union([], encounters), since };
}

/** All encounters found live since a time. */
export async function encountersSince(from) {
  const { records } = await historyIfAny('data.collision', { from: Math.floor(from), newest: 'encounter' });
  return union([], records.map(readEncounter).filter(Boolean));
}

/** Whether it is an encounter of two missions: those are not found in replays, as each has the devices of its own mission only. */
export function isBetween({ missions }) {
  return new Set(missions).size > 1;
}

/** Encounters found in replays, of all their epochs. @param {string[]} topics of results */
export async function encountersIn(topics) {
  const results = await Promise.all(topics.map((each) => historyIfAny(each, { from: 0, newest: 'encounter' })));
  return results.flatMap(({ records }) => records).map(readEncounter).filter(Boolean).sort((one, other) => other.epoch - one.epoch).reduce((all, each) => union(all, [each]), []);
}

/** @returns {Promise<{id: string, mission: string, time: number, note: string, author: string}[]>} sorted by time; empty without a MongoDB */
export async function markersOf(missions) {
  const lists = await Promise.all(missions.map((mission) => api.get(`/api/missions/${encodeURIComponent(mission)}/markers`).catch((error) => {
    if (error.status === 501 || error.status === 404) {
      return [];
    }
    throw error;
  })));
  return lists.flat().sort((one, other) => one.time - other.time);
}

export function removeMarker({ mission, id }) {
  return api.del(`/api/missions/${encodeURIComponent(mission)}/markers/${encodeURIComponent(id)}`);
}

export function addMarker(mission, time, note) {
  return api.post(`/api/missions/${encodeURIComponent(mission)}/markers`, { time: Math.round(time), note });
}
