/** Interprets NGSI-v2 entities, whatever their attributes are. */
import { hasUnit, shortId } from './format.js';
import { withDifference } from './identities.js';
import { parse } from './json.js';
import { Line } from './line.js';
import { codeOf, finite, isOfCommand, isPercent, jsonOf, positionOf, quantityOf, unitOf } from './readings.js';

/** Points stored of a trail or a series. */
const POINTS = 120;
/** Series stored of an entity. */
const MAX_SERIES = 24;
/** Further attributes and longer values are omitted. */
const MAX_ATTRIBUTES = 200;
const MAX_VALUE = 4_000;
/** Time after which an entity without a known period is stale, ms. */
const STALE_AFTER = 60_000;
const FRAME = new Set(['id', 'type']);
const NOT_A_SERIES = new Set(['Time', 'TimeInstant', 'Latitude', 'Longitude', 'latitude', 'longitude']);
/** Values of `Status` of a device that is switched off. */
const OFF_STATUS = new Set(['false', '0', 'off']);
const OFF_WORDS = new Set(['off', 'standby', 'sleeping']);
const ATTENTION_WORDS = new Set(['error', 'fault', 'faulty', 'failed', 'blocked', 'emergency', 'alarm']);

/**
 * The state of an entity.
 *
 * @typedef {Object} Entity
 * @property {string} id key in the page: the id of its identity, unless another entity has the same
 * @property {{key: string, id: string, service: string, servicePath: string, type: string}} identity in the context broker
 * @property {string} difference from other entities with its id, in words; empty if there are none
 * @property {string} type
 * @property {'robot'|'sensor'|'camera'|'other'} kind
 * @property {string} name
 * @property {Object<string, {type: string, value: *, metadata: Object, percent: boolean, time: number}>} attributes values of FIROS are parsed;
 *     `percent` if a number without a unit once exceeded 1
 * @property {number} time of its newest report, event time, epoch ms
 * @property {number} heard when a report was received last, epoch ms
 * @property {[number, number]|null} position degrees, longitude first
 * @property {string|null} positionFault why there is no position
 * @property {number} positionTime time of the report with the position or fault, epoch ms
 * @property {number|null} heading degrees clockwise from north
 * @property {number|null} speed m/s
 * @property {number|null} period observed, ms between reports
 * @property {{lon: number, lat: number, time: number}|null} place its newest distinct position
 * @property {Line} trail columns `lon`, `lat`, `time`, and for the map `x` and `y`; empty if it never moved
 * @property {Map<string, Line>} series numeric attributes, columns `times` and `values`
 * @property {string|null} domain
 * @property {string|null} mission
 * @property {string|null} word its state as reported
 * @property {'ok'|'attention'|'stale'|'off'} state
 * @property {boolean} suspect
 * @property {number} omitted number of omitted attributes
 */

const NO_TRAIL = new Line(['lon', 'lat', 'time'], 0);

/** @returns {Entity} */
export function newEntity(identity) {
  return {
    id: identity.key, identity, difference: '', type: '', kind: 'other', name: shortId(identity.id), attributes: Object.create(null), time: 0, heard: 0, position: null, positionFault: null, positionTime: 0, heading: null, speed: null,
    period: null, place: null, trail: NO_TRAIL, series: new Map(), domain: null, mission: null, word: null, state: 'ok', suspect: false, omitted: 0,
  };
}

/**
 * Merges a report into an entity: its attributes replace those with the same names that are not newer.
 *
 * @param {Entity} entity
 * @param {import('./stream.js').TopicRecord} record
 */
export function applyReport(entity, record) {
  const reported = record.value;
  entity.type = text(reported.type) || entity.type;
  let omitted = 0;
  let count = Object.keys(entity.attributes).length;
  for (const name in reported) {
    if (FRAME.has(name)) {
      continue;
    }
    if (!(name in entity.attributes) && ++count > MAX_ATTRIBUTES) {
      omitted++;
      continue;
    }
    const attribute = readAttribute(name, reported[name]);
    // the context broker may stamp the state of a command with another clock than the device its reports
    if (!(entity.attributes[name]?.time > record.time) || isOfCommand(name, attribute)) {
      entity.attributes[name] = { ...attribute, percent: isPercent(attribute) || Boolean(entity.attributes[name]?.percent), time: record.time };
    }
  }
  entity.omitted = omitted;
  const newer = record.time > entity.time;
  if (newer) {
    if (entity.time > 0 && record.kind === 'event') {
      const gap = record.time - entity.time;
      entity.period = entity.period === null ? gap : entity.period + 0.2 * (gap - entity.period);
    }
    entity.time = record.time;
  }
  entity.heard = Math.max(entity.heard, Number(record.headers?.['ts-source']) || record.time);
  describe(entity, record);
  if (newer) {
    appendPoints(entity, reported, record.time);
  }
}

function readAttribute(name, reported) {
  if (reported === null || typeof reported !== 'object' || Array.isArray(reported) || !('value' in reported)) {
    return { type: '', value: truncated(reported), metadata: {} };
  }
  const attribute = { type: text(reported.type), value: readValue(reported.value), metadata: reported.metadata ?? {} };
  // without a unit a text is not known to be a number: it may be a code with leading zeros
  const number = typeof attribute.value === 'string' && hasUnit(name, attribute) ? finite(attribute.value) : null;
  return number === null || (Number.isInteger(number) && !Number.isSafeInteger(number)) ? attribute : { ...attribute, value: number };
}

/** Parses values of FIROS: ROS messages as text with `%27` for quotes. */
export function readValue(value) {
  if (typeof value !== 'string') {
    return truncated(value);
  }
  if (value.startsWith('{%27') && value.length < MAX_VALUE) {
    try {
      const message = parse(jsonOf(value));
      const names = Object.keys(message);
      if (names.length === 1 && names[0] === 'data') {
        return message.data;
      }
      return names.length === 1 && typeof message[names[0]] === 'number' ? message[names[0]] : message;
    } catch {
      return truncated(value);
    }
  }
  return truncated(value);
}

function truncated(value) {
  if (typeof value === 'string') {
    return value.length > MAX_VALUE ? `${value.slice(0, MAX_VALUE)}…` : value;
  }
  if (value !== null && typeof value === 'object') {
    const size = JSON.stringify(value).length;
    return size > MAX_VALUE ? `${JSON.stringify(value).slice(0, MAX_VALUE)}…` : value;
  }
  return value;
}

function describe(entity, { value: reported, headers, time }) {
  const attributes = entity.attributes;
  entity.name = nameOf(entity);
  entity.kind = kindOf(entity);
  entity.domain = nameIn(attributes.Domain);
  entity.mission = nameIn(attributes.Mission);
  entity.speed = within(quantityOf(attributes.speed, 'SPEED'), Infinity);
  entity.heading = within(quantityOf(attributes.heading, 'HEADING'), 360);
  entity.word = wordOf(attributes);
  const found = positionOf(reported, headers);
  if ((found.position || found.fault) && time >= entity.positionTime) {
    entity.position = found.position ?? entity.position;
    entity.positionFault = found.fault ?? null;
    entity.positionTime = time;
  }
}

/** A name, which may be a whole number. */
function nameIn(attribute) {
  return text(attribute?.value) || (Number.isSafeInteger(attribute?.value) ? String(attribute.value) : null);
}

function within(number, max) {
  return number >= 0 && number <= max ? number : null;
}

/** The display name of an entity. */
export function nameOf({ attributes, identity, difference }) {
  const reported = text(attributes.name?.value) || text(attributes.Name?.value);
  const name = reported ? reported.slice(0, 80) : shortId(identity.id);
  return withDifference(name, difference);
}

function kindOf(entity) {
  const type = entity.type.toLowerCase();
  const attributes = entity.attributes;
  if (type.includes('robot') || type.includes('tractor') || type.includes('vehicle') || 'gnss' in attributes || 'cmd' in attributes) {
    return 'robot';
  }
  if (type.includes('camera') || 'Image' in attributes) {
    return 'camera';
  }
  const numbers = Object.entries(attributes).some(([name, each]) => typeof each.value === 'number' && !NOT_A_SERIES.has(name));
  return numbers ? 'sensor' : 'other';
}

function wordOf(attributes) {
  for (const name of ['state', 'status', 'State', 'Status']) {
    const value = attributes[name]?.value;
    if (name === 'Status' && OFF_STATUS.has(String(value).toLowerCase())) {
      return 'off';
    }
    if (typeof value === 'boolean') {
      return value ? 'on' : 'off';
    }
    if (typeof value === 'string' && value) {
      return value.slice(0, 40);
    }
  }
  return null;
}

function appendPoints(entity, reported, time) {
  if (entity.position) {
    addPlace(entity, ...entity.position, time);
  }
  for (const name in reported) {
    const attribute = entity.attributes[name];
    if (Number.isFinite(attribute?.value) && !NOT_A_SERIES.has(name)) {
      addNumber(entity.series, name, time, attribute);
    }
  }
}

function addPlace(entity, lon, lat, time) {
  const previous = entity.place;
  if (previous && previous.lon === lon && previous.lat === lat) {
    return;
  }
  entity.place = { lon, lat, time };
  if (!previous) {
    return;
  }
  if (entity.trail === NO_TRAIL) {
    entity.trail = new Line(['lon', 'lat', 'time', 'x', 'y'], POINTS);
    entity.trail.push(previous.lon, previous.lat, previous.time, NaN, NaN);
  }
  entity.trail.push(lon, lat, time, NaN, NaN);
}

/** Adds a number to its series, which begins anew with another unit. */
function addNumber(series, name, time, attribute) {
  const unit = codeOf(unitOf(attribute));
  let line = series.get(name);
  if (line ? line.unit !== unit : series.size < MAX_SERIES) {
    series.set(name, (line = Object.assign(new Line(['times', 'values'], POINTS), { unit })));
  }
  line?.push(time, attribute.value);
}

/**
 * Prepends earlier reports to the trail and series of an entity. They leave its attributes unchanged, but may show that those are in percent.
 *
 * @param {Entity} entity
 * @param {import('./stream.js').TopicRecord[]} records of the entity, oldest first
 */
export function applyPast(entity, records) {
  const past = { position: null, place: null, trail: NO_TRAIL, series: new Map(), attributes: Object.create(null) };
  for (const { time, value, headers } of records) {
    if (value === null || typeof value !== 'object' || Array.isArray(value) || time > entity.time) {
      continue;
    }
    for (const name in value) {
      if (!FRAME.has(name) && name in entity.attributes) {
        past.attributes[name] = readAttribute(name, value[name]);
        entity.attributes[name].percent ||= isPercent(past.attributes[name]);
      }
    }
    past.position = positionOf(value, headers).position ?? past.position;
    appendPoints(past, value, time);
  }
  entity.trail === NO_TRAIL ? (entity.trail = past.trail) : entity.trail.prepend(past.trail, 'time');
  for (const [name, line] of past.series) {
    const existing = entity.series.get(name);
    existing?.unit === line.unit ? existing.prepend(line, 'times') : existing ?? entity.series.set(name, line);
  }
  if (entity.period === null && records.length > 1) {
    entity.period = (records.at(-1).time - records[0].time) / (records.length - 1);
  }
}

/**
 * The state of an entity.
 *
 * @param {Entity} entity
 * @param {number} now the page's time, epoch ms
 * @param {number} reported when it reported last, by the same clock
 * @param {string|null} period configured by its mission, ISO 8601; null if there is none
 * @returns {'ok'|'attention'|'stale'|'off'}
 */
export function stateOf(entity, now, reported, period = null) {
  const word = entity.word?.toLowerCase() ?? '';
  if (OFF_WORDS.has(word)) {
    return 'off';
  }
  const configured = millisOf(period);
  const observed = entity.period === null ? STALE_AFTER : Math.min(10 * STALE_AFTER, 3 * entity.period);
  const timeout = Math.max(10_000, configured === null ? observed : 3 * configured);
  if (now - reported > timeout) {
    return 'stale';
  }
  return entity.suspect || entity.positionFault || ATTENTION_WORDS.has(word) ? 'attention' : 'ok';
}

/** Whether it reports that it stands still. */
export function isStopped(entity) {
  return /stop/i.test(entity.word ?? '');
}

/** Parses durations as the control plane writes them, such as PT1H30M or PT0.5S; null for others. */
function millisOf(duration) {
  const parts = /^PT(?:(\d+)H)?(?:(\d+)M)?(?:([\d.]+)S)?$/.exec(duration ?? '');
  return parts && 1000 * (3600 * (parts[1] ?? 0) + 60 * (parts[2] ?? 0) + Number(parts[3] ?? 0));
}

function text(value) {
  return typeof value === 'string' ? value : '';
}
