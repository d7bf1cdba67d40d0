/** Formats numbers, times and names. */
import { t, texts } from '../texts.js';
import { locale } from './language.js';
import { codeOf, unitOf } from './readings.js';

const SECOND = 1000;
const MINUTE = 60 * SECOND;
const HOUR = 60 * MINUTE;
const DAY = 24 * HOUR;

const clockFormat = new Intl.DateTimeFormat(locale, { hour: '2-digit', minute: '2-digit', second: '2-digit', hourCycle: 'h23' });
const dayFormat = new Intl.DateTimeFormat(locale, { day: 'numeric', month: 'short' });
const dateTimeFormat = new Intl.DateTimeFormat(locale, {
  day: 'numeric', month: 'short', year: 'numeric', hour: '2-digit', minute: '2-digit', second: '2-digit', hourCycle: 'h23',
});
const zoneFormat = new Intl.DateTimeFormat(locale, { timeZoneName: 'short' });
const decimalFormats = [1, 2].map((digits) => new Intl.NumberFormat(locale, { minimumFractionDigits: digits, maximumFractionDigits: digits, useGrouping: false }));

/** "4.60", "4,60": with 0 to 2 decimals. */
export function decimal(value, digits) {
  return digits === 0 ? value.toFixed(0) : decimalFormats[digits - 1].format(value);
}

/** "0.4 s ago". @param {number} ms how long ago */
export function age(ms) {
  return t('format.ago', { duration: duration(Math.max(0, ms)) });
}

/** "0.4 s", "12 s", "3 min", "2 h", "5 d". */
export function duration(ms) {
  if (!Number.isFinite(ms)) {
    return '–';
  }
  if (ms < 10 * SECOND) {
    return inUnit(decimal(ms / SECOND, 1), 'second');
  }
  if (ms < 2 * MINUTE) {
    return inUnit(Math.floor(ms / SECOND), 'second');
  }
  if (ms < 2 * HOUR) {
    return inUnit(Math.floor(ms / MINUTE), 'minute');
  }
  return ms < 2 * DAY ? inUnit(Math.floor(ms / HOUR), 'hour') : inUnit(Math.floor(ms / DAY), 'day');
}

/** "1:02:03" or "2:03": a length on a time axis. */
export function span(ms) {
  const seconds = Math.max(0, Math.floor(ms / SECOND));
  const [hours, minutes, rest] = [Math.floor(seconds / 3600), Math.floor(seconds / 60) % 60, seconds % 60];
  const two = (n) => String(n).padStart(2, '0');
  return hours ? `${hours}:${two(minutes)}:${two(rest)}` : `${minutes}:${two(rest)}`;
}

/** "10:42:07", local. */
export function clock(epochMs) {
  return Number.isFinite(epochMs) ? clockFormat.format(epochMs) : '–';
}

/** "21 Nov". */
export function day(epochMs) {
  return Number.isFinite(epochMs) ? dayFormat.format(epochMs) : '–';
}

/** "21 Nov 2026, 10:42:07". */
export function dateTime(epochMs) {
  return Number.isFinite(epochMs) ? dateTimeFormat.format(epochMs) : '–';
}

/** "10:42:07" today, else "21 Nov 2026, 10:42:07". */
export function moment(epochMs) {
  return day(epochMs) === day(Date.now()) && Math.abs(Date.now() - epochMs) < 2 * DAY ? clock(epochMs) : dateTime(epochMs);
}

/** "UTC+1". */
export function zone(epochMs) {
  const part = zoneFormat.formatToParts(epochMs).find((each) => each.type === 'timeZoneName')?.value ?? 'UTC';
  return part.replace('GMT', 'UTC');
}

/** At most two decimals, fewer for larger numbers; thousands are separated by spaces. */
export function number(value) {
  if (!Number.isFinite(value)) {
    return '–';
  }
  const size = Math.abs(value);
  if ((size >= 1e9 && !Number.isSafeInteger(value)) || (size > 0 && size < 0.001)) {
    return value.toExponential(2).replace('.', decimal(0.5, 1)[1]);
  }
  return size >= 100 || Number.isInteger(value)
    ? String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, ' ')
    : decimal(value, size >= 10 ? 1 : 2);
}

/** "4.6 m", "1.2 km". */
export function distance(meters) {
  if (!Number.isFinite(meters)) {
    return '–';
  }
  return meters < 1000 ? inUnit(decimal(meters, meters < 100 ? 1 : 0), 'meter') : inUnit(decimal(meters / 1000, 1), 'kilometer');
}

/** "1.25 ha". */
export function area(hectares) {
  return Number.isFinite(hectares) ? inUnit(decimal(hectares, 2), 'hectare') : '–';
}

/** "62 %". @param {number} share 0 to 1 */
export function percent(share) {
  return Number.isFinite(share) ? inUnit(decimal(100 * share, 0), 'percent') : '–';
}

/** "12.4 °C". */
export function temperature(celsius) {
  return Number.isFinite(celsius) ? inUnit(decimal(celsius, 1), 'celsius') : '–';
}

/** "1.2 kB", "3.4 MB". */
export function bytes(count) {
  const units = ['byte', 'kilobyte', 'megabyte', 'gigabyte', 'terabyte'];
  let value = count;
  let unit = 0;
  while (value >= 1000 && unit < units.length - 1) {
    value /= 1000;
    unit++;
  }
  return inUnit(decimal(value, unit === 0 ? 0 : 1), units[unit]);
}

function inUnit(value, unit) {
  return `${value} ${t(`units.${unit}`)}`;
}

/** UN/CEFACT units of FIWARE's data models, and the units of common attributes that name none. */
const UNIT_CODES = {
  __proto__: null,
  CEL: 'celsius', MTS: 'meterPerSecond', KMH: 'kilometerPerHour', P1: 'percent', MTR: 'meter', DD: 'degree', HPA: 'hectopascal', A97: 'hectopascal', LUX: 'lux',
  VLT: 'volt', AMP: 'ampere', WTT: 'watt', MMT: 'millimeter', D54: 'wattPerSquareMeter',
};
const DEFAULT_UNITS = {
  __proto__: null,
  temperature: 'celsius', soiltemperature: 'celsius', dewpoint: 'celsius', speed: 'meterPerSecond', windspeed: 'meterPerSecond', heading: 'degree', winddirection: 'degree',
  humidity: 'percent', relativehumidity: 'percent', soilmoisture: 'percent', battery: 'percent', batterylevel: 'percent', pressure: 'hectopascal', atmosphericpressure: 'hectopascal', altitude: 'meter',
  illuminance: 'lux', voltage: 'volt', precipitation: 'millimeter', rainfall: 'millimeter', solarradiation: 'wattPerSquareMeter',
};
/** A share of a whole, 0 to 1. */
const SHARE_CODE = 'C62';
/** Units shown without decimals. */
const WHOLE = new Set(['percent', 'degree']);
const SHARES = new Set(['battery', 'relativehumidity', 'humidity', 'batterylevel']);

/**
 * Formats an attribute.
 *
 * @param {string} name
 * @param {{value: *, metadata: Object=}} attribute as parsed by `core/entity.js`
 * @returns {{label: string, value: string, unit: string, numeric: boolean}}
 */
export function quantity(name, attribute) {
  const { value } = attribute;
  if (typeof value === 'number') {
    const { factor, unit, words } = displayOf(name, attribute);
    const shown = value * factor;
    return { label: label(name), value: WHOLE.has(unit) ? String(Math.round(shown)) : number(shown), unit: words, numeric: true };
  }
  return { label: label(name), value: plain(value), unit: '', numeric: false };
}

/**
 * How a number of an attribute is shown.
 *
 * @param {{value: number, metadata: Object=, percent: boolean=}} attribute
 * @returns {{factor: number, unit: string|undefined, words: string}} `words` of the unit
 */
export function displayOf(name, attribute) {
  const { value } = attribute;
  const reported = unitOf(attribute);
  const code = codeOf(reported);
  const isShare = SHARES.has(name.toLowerCase()) && (code === SHARE_CODE || (code === '' && value >= 0 && value <= 1 && !attribute.percent));
  const unit = isShare ? 'percent' : unitNamed(name, code);
  return { factor: isShare ? 100 : 1, unit, words: unit ? t(`units.${unit}`) : reported.slice(0, 12) };
}

/** Whether an attribute is a quantity, by its metadata or its name. */
export function hasUnit(name, attribute) {
  return unitOf(attribute) !== '' || unitNamed(name, '') !== undefined;
}

function unitNamed(name, code) {
  return code ? UNIT_CODES[code] : DEFAULT_UNITS[name.toLowerCase()];
}

/** A value as one line of text, truncated to `limit` characters. */
export function plain(value, limit = 120) {
  if (value === null || value === undefined || value === '') {
    return '–';
  }
  if (typeof value === 'boolean') {
    return t(value ? 'format.yes' : 'format.no');
  }
  const text = typeof value === 'object' ? JSON.stringify(value).slice(0, limit + 1) : String(value).slice(0, limit + 1);
  return text.length > limit ? `${text.slice(0, limit)}…` : text;
}

/** "windSpeed", "wind_speed" → "Wind speed", or as the language names it. */
export function label(name) {
  const own = name.slice(0, 60).replace(/([a-z0-9])([A-Z])/g, '$1 $2').replace(/[_\s]+/g, ' ').trim();
  const words = word(own);
  const lower = /^[A-Z0-9]{2,5}$/.test(words) ? words : words.toLowerCase();
  return lower.charAt(0).toUpperCase() + lower.slice(1);
}

/** A word that devices or the server use, in the language of the page if it has it. @param {'words'|'commands'|'reported'=} section */
export function word(own, section = 'words') {
  const name = own.toLowerCase();
  return texts[section] && Object.hasOwn(texts[section], name) ? texts[section][name] : own;
}

/** "urn:ngsi-ld:Thermometer:4" → "Thermometer 4". */
export function shortId(id) {
  const text = String(id).slice(0, 120);
  const parts = text.split(':');
  return text.startsWith('urn:ngsi-ld:') && parts.length >= 4 ? `${parts[2]} ${parts.slice(3).join(':')}` : text;
}

/** Replaces the ids and the times in a sentence by readable ones. */
export function readable(sentence, limit = 500) {
  return String(sentence).slice(0, limit).replace(/urn:ngsi-ld:[A-Za-z]+:[\w-]+/g, (id) => shortId(id)).replace(/\b\d{4}-\d\d-\d\dT[\d:.]+Z/g, (time) => moment(Date.parse(time)));
}
