/** Reads what a mission's report shows: from the topics of results as far as they retain it, and from the control plane. */
import { api } from '../../core/api.js';
import { readCoverage } from '../../core/coverage.js';
import { differenceOf, withDifference } from '../../core/identities.js';
import { store } from '../../core/store.js';
import { encountersOf, historyIfAny, markersOf } from '../../timeline/moments.js';
import { readAverage } from '../analyses/data.js';

/** How much later than the last event what was worked by then may be reported, ms. */
const REPORT_DELAY = 60_000;
/** Between two runs nothing is recorded for at least this time, ms. */
const PAUSE = 300_000;
/** Parts of the recording of which it is known whether anything was recorded. */
const BUCKETS = 1_000;
/** No mission is longer, ms: a report with a time far off is part of the recording. */
const YEAR = 366 * 86_400_000;
const LISTS = ['missions', 'recordings', 'fields', 'domains', 'alarms'];

/**
 * A part of a report, or why it could not be read.
 *
 * @typedef {{rows: Object[], since: number=, error: Error=}} Part `since`: epoch ms from which on it is complete
 */
/**
 * A report.
 *
 * @typedef {Object} Report
 * @property {Object|null} mission of the REST API; null if it was deleted @property {number} from @property {number} to epoch ms @property {boolean} isRunning
 * @property {boolean} isCut whether the recording has times that are years off, which are left out @property {Part} runs the times in which it was recorded
 * @property {Object[]} fields as they were at the end @property {import('../../core/coverage.js').Coverage[]} layers
 * @property {Part} coverages of fields @property {Part} encounters @property {Part} averages @property {Part} alarms @property {Part} markers @property {Part} devices
 */

/** @param {string} name of the mission @returns {Promise<Report|null>} null if it has not begun, or nothing is known of it @throws {Error} */
export async function readReport(name) {
  const [mission] = await Promise.all([missionOf(name), listsRead()]);
  const recording = store.recordings.get(name);
  const isRunning = Boolean(mission?.running);
  const isCut = recording?.last - recording?.first > YEAR;
  const from = isCut ? mission?.start ?? mission?.created ?? recording.last - YEAR : recording?.first ?? mission?.start;
  if (from === undefined || from > Date.now()) {
    if (store.lists.recordings.error && !mission) {
      throw store.lists.recordings.error;
    }
    return null;
  }
  const to = Math.max(from, isRunning ? Date.now() : recording?.last ?? mission.status?.since ?? from);
  const [work, encounters, averages, markers, devices, clocks, runs] = await Promise.all([
    workOf(name, from, to), encountersOf([name], from, to), averagesIn(from, to), markersOf([name]), devicesOf(name), clocksIn(from, to), recording ? runsOf(name, from, to) : Promise.resolve([{ from, to }]),
  ].map(settled));
  const worked = (work.value?.coverages ?? []).filter(({ device }) => !device);
  const fields = fieldsOf(mission?.domain ?? worked[0]?.domain ?? null, worked, to);
  const known = new Set([...(devices.value ?? []), ...(work.value?.coverages ?? []).map(({ device }) => ({ id: device }))].map(({ id }) => id));
  return {
    mission, from, to, isRunning, isCut, fields, layers: work.value?.layers ?? [], runs: part(runs, (value) => value),
    coverages: part(work, ({ coverages }) => coverages.filter(({ device }) => !device)),
    encounters: part(encounters, (value) => value.encounters),
    averages: part(averages, (value) => summaries(value.averages, fields)),
    alarms: store.lists.alarms.error && store.lists.alarms.loading ? { rows: [], error: store.lists.alarms.error } : { rows: alarmsOf(name, known, from, to) },
    markers: part(markers, (value) => value),
    devices: part(devices, (value) => withWork(value, (work.value?.coverages ?? []).filter(({ device }) => device), clocks.value ?? new Map())),
  };
}

/** Waits until the lists of the store have been read, or could not be. */
function listsRead() {
  return new Promise((resolve) => {
    let subscriptions = [];
    const check = () => {
      if (LISTS.every((name) => !store.lists[name].loading || store.lists[name].error)) {
        subscriptions.forEach((unsubscribe) => unsubscribe());
        resolve();
      }
    };
    subscriptions = LISTS.map((name) => store.on(name, check));
    check();
  });
}

async function missionOf(name) {
  try {
    return await api.get(`/api/missions/${encodeURIComponent(name)}`);
  } catch (error) {
    if (error.status === 404) {
      return null;
    }
    throw error;
  }
}

function devicesOf(name) {
  return api.get(`/api/devices?mission=${encodeURIComponent(name)}`).catch((error) => {
    if (error.status === 404) {
      return [];
    }
    throw error;
  });
}

async function workOf(name, from, to) {
  const range = { from: Math.floor(from), to: Math.ceil(to) + REPORT_DELAY, newest: 'id' };
  const [figures, layers] = await Promise.all([historyIfAny('data.coverage', range), historyIfAny('data.coverage.layer', range)]);
  const [coverages, cells] = [figures, layers].map(({ records }) => records.map(readCoverage).filter((each) => each?.mission === name));
  return { coverages, layers: cells, since: figures.since };
}

async function averagesIn(from, to) {
  const { records, since } = await historyIfAny('data.temperature', { from: Math.floor(from), to: Math.ceil(to) + 1 });
  return { averages: records.map((record) => readAverage(record, '')).filter(Boolean), since };
}

/** How late reports of devices were, by their ids, ms: of those that the jobs found behind. */
async function clocksIn(from, to) {
  const { records } = await historyIfAny('data.clocks', { from: Math.floor(from), to: Math.ceil(to) + REPORT_DELAY, newest: 'id' });
  return new Map(records.map(({ value }) => [value?.device?.value, value?.late?.value ?? value?.offset?.value]).filter(([id, late]) => typeof id === 'string' && Number.isFinite(late)));
}

/** The times in which events were recorded, from pause to pause; the whole time while the events are being counted. */
async function runsOf(name, from, to) {
  const timeline = await api.get(`/api/recordings/${encodeURIComponent(name)}/timeline?${new URLSearchParams({ from: Math.floor(from), to: Math.ceil(to) + 1, buckets: BUCKETS })}`);
  const runs = [];
  timeline.counts.forEach((count, bucket) => {
    const [begin, end] = [timeline.from + bucket * timeline.width, timeline.from + (bucket + 1) * timeline.width];
    if (count !== 0) {
      begin - runs.at(-1)?.to < PAUSE ? (runs.at(-1).to = end) : runs.push({ from: begin, to: end });
    }
  });
  return runs.length > 1 ? runs.map((run) => ({ from: Math.max(run.from, from), to: Math.min(run.to, to) })) : [{ from, to }];
}

/** The fields of a domain at a time, and those that were worked. */
function fieldsOf(domain, worked, time) {
  const listed = new Set([...(store.domains.get(domain)?.fields ?? []), ...worked.map(({ field }) => field)]);
  return [...store.fieldVersions.keys()].map((id) => store.fieldAt(id, time))
    .filter((field) => field && !field.exclusion && (listed.has(field.id) || (domain !== null && field.properties.Domain === domain)))
    .sort((one, other) => one.name.localeCompare(other.name, undefined, { numeric: true }));
}

/** The averages of each field, in one: the mean over its windows, weighted by their lengths. */
function summaries(averages, fields) {
  const names = new Map(fields.map(({ id, name }) => [id, name]));
  const lines = new Map();
  averages.filter(({ field }) => names.has(field)).forEach((each) => lines.set(each.line, [...(lines.get(each.line) ?? []), each]));
  const firsts = [...lines.values()].map(([first]) => first);
  return [...lines.values()].map((windows) => {
    const [{ field }] = windows;
    const values = windows.map(({ value }) => value);
    const lengths = windows.map(({ start, end }) => Math.max(1, end - start));
    const sum = lengths.reduce((total, length) => total + length, 0);
    return {
      name: withDifference(names.get(field), differenceOf(windows[0], firsts.filter((each) => each.field === field))), windows: windows.length,
      mean: values.reduce((total, value, i) => total + value * lengths[i], 0) / sum, min: Math.min(...values), max: Math.max(...values), suspects: [...new Set(windows.flatMap(({ suspects }) => suspects))],
    };
  });
}

/** The alarms of the mission and its devices that were open in a period; those closed more than a day ago are not retained. */
function alarmsOf(name, devices, from, to) {
  const id = `urn:ngsi-ld:Mission:${name}`;
  return [...store.alarms.values()].filter((alarm) => alarm.raised <= to && (alarm.state !== 'closed' || alarm.changed >= from)
    && (alarm.group === id || alarm.subject === id || (alarm.devices ?? []).some((each) => devices.has(each.id)))).sort((one, other) => one.raised - other.raised);
}

/** The devices with what each has worked, and how late its reports were; those that worked and are not registered any more, too. */
function withWork(devices, coverages, clocks) {
  const all = new Map(devices.map(({ id, type, status }) => [id, { id, type: type ?? '', state: status?.state ?? '' }]));
  for (const { device, deviceType, figures } of coverages) {
    const existing = all.get(device) ?? { id: device, type: deviceType, state: '' };
    all.set(device, { ...existing, hectares: (existing.hectares ?? 0) + figures.hectares, overlap: (existing.overlap ?? 0) + figures.overlap });
  }
  return [...all.values()].map((each) => ({ ...each, late: clocks.get(each.id) ?? null })).sort((one, other) => one.id.localeCompare(other.id, undefined, { numeric: true }));
}

function settled(promise) {
  return promise.then((value) => ({ value }), (error) => ({ error }));
}

function part({ value, error }, rowsOf) {
  return error ? { rows: [], error } : { rows: rowsOf(value), since: value.since };
}
