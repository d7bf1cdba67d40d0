/** What the page makes of an NGSI-v2 entity, whatever its attributes are. */
import { hasUnit, shortId } from './format.js';
import { parse } from './json.js';
import { Line } from './line.js';
import { finite, isPercent, positionOf, quantityOf } from './readings.js';

/** Points that are kept of a trail and of a number. */
const POINTS = 120;
/** Numbers of an entity that are kept. */
const MAX_SERIES = 24;
/** Of an entity with more attributes, or longer values, the rest is left out. */
const MAX_ATTRIBUTES = 200;
const MAX_VALUE = 4_000;
/** Without a known period an entity is stale after this, ms. */
const STALE_AFTER = 60_000;
const FRAME = new Set(['id', 'type']);
const NOT_A_SERIES = new Set(['Time', 'TimeInstant', 'Latitude', 'Longitude', 'latitude', 'longitude']);
const OFF_WORDS = new Set(['off', 'stopped', 'standby', 'sleeping']);
/** Command states: the context broker may stamp them with another clock than the device its reports. */
const COMMAND_STATE = /_(status|info)$/;
const ATTENTION_WORDS = new Set(['error', 'fault', 'faulty', 'failed', 'blocked', 'emergency', 'alarm']);

/**
 * @typedef {Object} Entity
 * @property {string} id under which the page has it: that of its identity, unless another entity has the same
 * @property {{key: string, id: string, service: string, servicePath: string, type: string}} identity as the context broker has it
 * @property {string} difference from other entities of its id, in words; empty where there are none
 * @property {string} type
 * @property {'robot'|'sensor'|'camera'|'other'} kind
 * @property {string} name
 * @property {Object<string, {type: string, value: *, metadata: Object, percent: boolean, time: number}>} attributes values of FIROS are read;
 *     `percent` where a number without a unit was once more than 1
 * @property {number} time of its newest report, event time, epoch ms
 * @property {[number, number]|null} position degrees, longitude first
 * @property {string|null} positionFault why there is none
 * @property {number} positionTime of the report that said either, epoch ms
 * @property {number|null} heading degrees clockwise from north
 * @property {number|null} speed m/s
 * @property {number|null} period ms between reports, as seen
 * @property {{lon: number, lat: number, time: number}|null} place where it came to last
 * @property {Line} trail columns `lon`, `lat`, `time`, and for the map `x` and `y`; empty for one that never moved
 * @property {Map<string, Line>} series numbers as they were, columns `times` and `values`
 * @property {string|null} domain
 * @property {string|null} mission
 * @property {string|null} word what the entity says of its state
 * @property {'ok'|'attention'|'stale'|'off'} state
 * @property {boolean} suspect
 * @property {number} omitted attributes that were left out
 */

const NO_TRAIL = new Line(['lon', 'lat', 'time'], 0);

/** @returns {Entity} */
export function newEntity(identity) {
  return {
    id: identity.key, identity, difference: '', type: '', kind: 'other', name: shortId(identity.id), attributes: Object.create(null), time: 0, position: null, positionFault: null, positionTime: 0, heading: null, speed: null,
    period: null, place: null, trail: NO_TRAIL, series: new Map(), domain: null, mission: null, word: null, state: 'ok', suspect: false, omitted: 0,
  };
}

/**
 * Takes a report into an entity: its attributes in the place of those of the same names that are not newer.
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
    } else if (!(entity.attributes[name]?.time > record.time) || COMMAND_STATE.test(name)) {
      const attribute = readAttribute(name, reported[name]);
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
  describe(entity, reported, record.time);
  if (newer) {
    remember(entity, reported, record.time);
  }
}

function readAttribute(name, reported) {
  if (reported === null || typeof reported !== 'object' || Array.isArray(reported) || !('value' in reported)) {
    return { type: '', value: cut(reported), metadata: {} };
  }
  const attribute = { type: text(reported.type), value: readValue(reported.value), metadata: reported.metadata ?? {} };
  // of any other text nobody says that it is a number: it may be one with zeros in front
  return typeof attribute.value === 'string' && hasUnit(name, attribute) ? { ...attribute, value: finite(attribute.value) ?? attribute.value } : attribute;
}

/** Values of FIROS are messages of ROS as text, whose quotes are written `%27`. */
function readValue(value) {
  if (typeof value !== 'string') {
    return cut(value);
  }
  if (value.startsWith('{%27') && value.length < MAX_VALUE) {
    try {
      const message = parse(value.replaceAll('%27', '"'));
      const names = Object.keys(message);
      if (names.length === 1 && names[0] === 'data') {
        return message.data;
      }
      return names.length === 1 && typeof message[names[0]] === 'number' ? message[names[0]] : message;
    } catch {
      return cut(value);
    }
  }
  return cut(value);
}

function cut(value) {
  if (typeof value === 'string') {
    return value.length > MAX_VALUE ? `${value.slice(0, MAX_VALUE)}…` : value;
  }
  if (value !== null && typeof value === 'object') {
    const size = JSON.stringify(value).length;
    return size > MAX_VALUE ? `${JSON.stringify(value).slice(0, MAX_VALUE)}…` : value;
  }
  return value;
}

function describe(entity, reported, time) {
  const attributes = entity.attributes;
  entity.name = named(entity);
  entity.kind = kindOf(entity);
  entity.domain = text(attributes.Domain?.value) || null;
  entity.mission = text(attributes.Mission?.value) || null;
  entity.speed = quantityOf(attributes.speed ?? attributes.Speed, 'SPEED');
  entity.heading = quantityOf(attributes.heading ?? attributes.Heading, 'HEADING');
  entity.word = wordOf(attributes);
  const found = positionOf(reported);
  if ((found.position || found.fault) && time >= entity.positionTime) {
    entity.position = found.position ?? entity.position;
    entity.positionFault = found.fault ?? null;
    entity.positionTime = time;
  }
}

/** What people call it. */
export function named({ attributes, identity, difference }) {
  const given = text(attributes.name?.value) || text(attributes.Name?.value);
  const name = given ? given.slice(0, 80) : shortId(identity.id);
  return difference ? `${name} (${difference.slice(0, 80)})` : name;
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
    if (typeof value === 'boolean') {
      return value ? 'on' : 'off';
    }
    if (typeof value === 'string' && value) {
      return value.slice(0, 40);
    }
  }
  return null;
}

function remember(entity, reported, time) {
  if (entity.position) {
    addPlace(entity, ...entity.position, time);
  }
  for (const name in reported) {
    const value = entity.attributes[name]?.value;
    if (typeof value === 'number' && Number.isFinite(value) && !NOT_A_SERIES.has(name)) {
      addNumber(entity.series, name, time, value);
    }
  }
}

function addPlace(entity, lon, lat, time) {
  const before = entity.place;
  if (before && before.lon === lon && before.lat === lat) {
    return;
  }
  entity.place = { lon, lat, time };
  if (!before) {
    return;
  }
  if (entity.trail === NO_TRAIL) {
    entity.trail = new Line(['lon', 'lat', 'time', 'x', 'y'], POINTS);
    entity.trail.push(before.lon, before.lat, before.time, NaN, NaN);
  }
  entity.trail.push(lon, lat, time, NaN, NaN);
}

function addNumber(series, name, time, value) {
  let line = series.get(name);
  if (!line && series.size < MAX_SERIES) {
    series.set(name, (line = new Line(['times', 'values'], POINTS)));
  }
  line?.push(time, value);
}

/**
 * Takes what was reported before all that an entity holds of its trail and its series: in front of them. Its attributes stay.
 *
 * @param {Entity} entity
 * @param {import('./stream.js').TopicRecord[]} records of the entity, oldest first
 */
export function applyPast(entity, records) {
  const past = { position: null, place: null, trail: NO_TRAIL, series: new Map(), attributes: Object.create(null) };
  for (const { time, value } of records) {
    if (value === null || typeof value !== 'object' || Array.isArray(value) || time > entity.time) {
      continue;
    }
    for (const name in value) {
      !FRAME.has(name) && name in entity.attributes && (past.attributes[name] = readAttribute(name, value[name]));
    }
    past.position = positionOf(value).position ?? past.position;
    remember(past, value, time);
  }
  entity.trail === NO_TRAIL ? (entity.trail = past.trail) : entity.trail.prepend(past.trail, 'time');
  for (const [name, line] of past.series) {
    entity.series.has(name) ? entity.series.get(name).prepend(line, 'times') : entity.series.set(name, line);
  }
  if (entity.period === null && records.length > 1) {
    entity.period = (records.at(-1).time - records[0].time) / (records.length - 1);
  }
}

/**
 * @param {Entity} entity
 * @param {number} now of what is shown, epoch ms
 * @param {string|null} period as its mission says, ISO 8601; null if it does not
 * @returns {'ok'|'attention'|'stale'|'off'}
 */
export function stateOf(entity, now, period = null) {
  const word = entity.word?.toLowerCase() ?? '';
  if (OFF_WORDS.has(word)) {
    return 'off';
  }
  const desired = millisOf(period);
  const seen = entity.period === null ? STALE_AFTER : Math.min(10 * STALE_AFTER, 3 * entity.period);
  const timeout = Math.max(10_000, desired === null ? seen : 3 * desired);
  if (now - entity.time > timeout) {
    return 'stale';
  }
  return entity.suspect || entity.positionFault || ATTENTION_WORDS.has(word) ? 'attention' : 'ok';
}

/** Of a duration as the control plane writes it, for instance PT1H30M or PT0.5S; else null. */
function millisOf(duration) {
  const parts = /^PT(?:(\d+)H)?(?:(\d+)M)?(?:([\d.]+)S)?$/.exec(duration ?? '');
  return parts && 1000 * (3600 * (parts[1] ?? 0) + 60 * (parts[2] ?? 0) + Number(parts[3] ?? 0));
}

function text(value) {
  return typeof value === 'string' ? value : '';
}
