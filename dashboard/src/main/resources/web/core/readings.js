/**
 * Reads positions, numbers, units and commands exactly as the jobs do: `PositionReading`, `Numbers`, `Quantity` and `Entity` of the model, `Battery`
 * of the control plane. The tables of cases in the tests of the model apply to this file too.
 */

const DECIMAL = /^[+-]?(\d{1,40}(\.\d{0,40})?|\.\d{1,40})([eE][+-]?\d{1,3})?$/;
const SPACE = 0x20;
/** Java's white space, which excludes spaces that do not break a line. */
const BLANK = /^[\t-\r\x1c- \u1680\u2000-\u2006\u2008-\u200a\u2028\u2029\u205f\u3000]*$/;
const PAIRS = [['Latitude', 'Longitude'], ['latitude', 'longitude']];
const POSITIONS = ['location', 'gnss', 'pose', ...PAIRS.flat()];
const BATTERIES = ['battery', 'batteryLevel'];
const QUOTE = '%27';
const COMMAND_TYPE = /^command(Status|Result)?$/;
const COMMAND_OF_ROBOTS = /^cmd(_(status|info))?$/;
/** Words of the IoT Agent for a command without a result. */
const PROGRESS = new Set(['PENDING', 'SENT', 'DELIVERED', 'EXPIRED']);

/** Conversions to the unit of each quantity; other units are rejected, except for temperatures. */
const QUANTITIES = {
  SPEED: { __proto__: null, MTS: (value) => value, KMH: (value) => value / 3.6, HM: (value) => value * 0.44704, KNT: (value) => (value * 1852) / 3600 },
  HEADING: { __proto__: null, DD: (value) => value, C81: (value) => (value * 180) / Math.PI },
  TEMPERATURE: { __proto__: null, FAH: (value) => (value - 32) / 1.8, KEL: (value) => value - 273.15 },
  SHARE: { __proto__: null, C62: (value) => value, P1: (value) => value / 100 },
  LENGTH: { __proto__: null, MTR: (value) => value, CMT: (value) => value / 100, MMT: (value) => value / 1000, FOT: (value) => value * 0.3048, INH: (value) => value * 0.0254 },
};

/** Codes of UN/CEFACT by spellings in lower case. */
const SPELLINGS = {
  __proto__: null,
  'm/s': 'MTS', 'km/h': 'KMH', kph: 'KMH', mph: 'HM', kn: 'KNT', kt: 'KNT', kts: 'KNT', knots: 'KNT', '°': 'DD', deg: 'DD', degree: 'DD', degrees: 'DD', rad: 'C81',
  c: 'CEL', '℃': 'CEL', celsius: 'CEL', f: 'FAH', '℉': 'FAH', fahrenheit: 'FAH', k: 'KEL', kelvin: 'KEL', '%': 'P1', percent: 'P1',
  m: 'MTR', meter: 'MTR', meters: 'MTR', metre: 'MTR', metres: 'MTR', cm: 'CMT', mm: 'MMT', ft: 'FOT', feet: 'FOT', in: 'INH',
};
/** Spellings such as `°C`, `degF`, `degrees Celsius`, and QUDT's `…/unit/DEG_F`. */
const DEGREES = /^(?:.*[/:])?(?:[°º]|deg(?:rees?)?)[ _]?([cfk])[a-z]*$/;

/** A finite number, also given as text or as a FIROS message with one number; null for everything else. */
export function finite(value) {
  const text = typeof value === 'string' ? trimmed(value) : '';
  const number = DECIMAL.test(text) ? Number(text) : text.startsWith(`{${QUOTE}`) ? only(messageOf(text)) : value;
  return typeof number === 'number' && Number.isFinite(number) ? number : null;
}

function only(message) {
  const members = Object.values(message ?? {});
  return members.length === 1 ? finite(members[0]) : null;
}

/** Trims as Java does: removes characters up to U+0020 at both ends. */
function trimmed(text) {
  let [from, to] = [0, text.length];
  while (from < to && text.charCodeAt(from) <= SPACE) {
    from++;
  }
  while (from < to && text.charCodeAt(to - 1) <= SPACE) {
    to--;
  }
  return text.slice(from, to);
}

/** Metadata `unitCode`, a code of UN/CEFACT Recommendation 20, else `unit`; empty if there is none. */
export function unitOf(attribute) {
  const { unitCode, unit } = attribute?.metadata ?? {};
  const named = unit?.value ?? '';
  return typeof unitCode?.value === 'string' && unitCode.value ? unitCode.value : typeof named === 'object' ? '' : String(named);
}

/** The code of a unit given as a code or as a common spelling. */
export function codeOf(unit) {
  const name = trimmed(unit);
  const lower = name.toLowerCase();
  return SPELLINGS[DEGREES.exec(lower)?.[1] ?? lower] ?? name.toUpperCase();
}

/**
 * Reads a quantity in its unit.
 *
 * @param {{value: *, metadata: Object=}|undefined} attribute
 * @param {'SPEED'|'HEADING'|'TEMPERATURE'|'SHARE'} quantity in m/s, degrees, °C, 0 to 1
 * @returns {number|null} null for values that are not numbers or have another unit
 */
export function quantityOf(attribute, quantity) {
  const number = finite(attribute?.value);
  const code = codeOf(unitOf(attribute));
  if (number === null || code === '') {
    return number;
  }
  const read = QUANTITIES[quantity][code];
  return read ? read(number) : quantity === 'TEMPERATURE' ? number : null;
}

/**
 * Whether an attribute is a command or its state, which others than the device write.
 *
 * @param {{type: string, value: *}} attribute
 */
export function isOfCommand(name, { type, value }) {
  return COMMAND_TYPE.test(type) || COMMAND_OF_ROBOTS.test(name) || (name.endsWith('_status') && PROGRESS.has(value));
}

/** Whether the value of a share shows that the device reports percent without naming a unit. */
export function isPercent(attribute) {
  return unitOf(attribute) === '' && finite(attribute.value) > 1;
}

/**
 * Marks the battery as one of a device that reports percent without naming a unit.
 *
 * @param {Object<string, Object>} attributes
 * @returns {boolean} whether it was not marked
 */
export function markPercent(attributes) {
  const unmarked = BATTERIES.map((name) => attributes[name]).filter((battery) => battery && !battery.percent);
  unmarked.forEach((battery) => (battery.percent = true));
  return unmarked.length > 0;
}

/** The charge of a battery, 0 to 1. @param {Object<string, Object>} attributes as parsed by `core/entity.js` @returns {number|null} */
export function chargeOf(attributes) {
  const attribute = attributes[BATTERIES.find((name) => isPresent(attributes[name]?.value))];
  const number = finite(attribute?.value);
  const reading = number ?? finite(messageOf(attribute?.value)?.percentage);
  const isNamed = number !== null && unitOf(attribute) !== '';
  const share = isNamed ? quantityOf(attribute, 'SHARE') : reading > 1 || (number !== null && attribute?.percent) ? reading / 100 : reading;
  return reading !== null && share !== null && share >= 0 && share <= 1 ? share : null;
}

/**
 * The position in a report.
 *
 * @param {Object<string, {value: *}>} reported attributes of one record
 * @param {Object<string, string>} headers of the record; `later-attributes` names attributes that are later than it
 * @returns {{position: [number, number]}|{fault: 'no-number'|'no-point'|'out-of-range'|'no-fix'}|{}} degrees, longitude first; empty if the report
 *     has none
 */
export function positionOf(reported, headers = {}) {
  const later = headers['later-attributes']?.split(',') ?? [];
  if (POSITIONS.some((name) => later.includes(name))) {
    return {};
  }
  const value = (name) => (Object.hasOwn(reported, name) ? reported[name]?.value ?? undefined : undefined);
  const location = value('location');
  if (isPresent(location) && !isBlank(location)) {
    return ofLocation(location);
  }
  for (const [latitude, longitude] of PAIRS) {
    if (isPresent(value(latitude)) || isPresent(value(longitude))) {
      return checked(value(longitude), value(latitude));
    }
  }
  const text = [value('gnss'), value('pose')].find((each) => typeof each === 'string' && !isBlank(each));
  if (text === undefined) {
    return {};
  }
  const message = messageOf(text);
  return checked(message?.longitude, message?.latitude);
}

function ofLocation(location) {
  if (typeof location === 'string') {
    const parts = location.split(',');
    return parts.length === 2 ? checked(parts[1], parts[0]) : { fault: 'no-point' };
  }
  const { type, coordinates } = location;
  return type === 'Point' && Array.isArray(coordinates) && coordinates.length >= 2 ? checked(coordinates[0], coordinates[1]) : { fault: 'no-point' };
}

function checked(longitude, latitude) {
  const [lon, lat] = [finite(longitude), finite(latitude)];
  if (lon === null || lat === null) {
    return { fault: 'no-number' };
  }
  if (Math.abs(lat) > 90 || Math.abs(lon) > 180) {
    return { fault: 'out-of-range' };
  }
  return lat === 0 && lon === 0 ? { fault: 'no-fix' } : { position: [lon, lat] };
}

/** The JSON of a ROS message, which FIROS writes with `%27` for quotes; ROS writes numbers that are not measured as NaN, which become null. */
export function jsonOf(message) {
  return message.replaceAll(QUOTE, '"').replace(/"(?:[^"\\]|\\.)*"|NaN|-?Infinity/g, (found) => (found.startsWith('"') ? found : 'null'));
}

function messageOf(value) {
  if (typeof value !== 'string') {
    return value;
  }
  try {
    return JSON.parse(jsonOf(value));
  } catch {
    return null;
  }
}

function isPresent(value) {
  return value !== undefined && value !== null;
}

function isBlank(value) {
  return typeof value === 'string' && BLANK.test(value);
}
