/** Selects the attributes that a card shows. */
import { dateTime, plain, quantity } from '../core/format.js';
import { isOfCommand } from '../core/readings.js';

/** Names, positions, times and the command, which say as texts what is shown elsewhere. */
export const CONTEXT = [
  'Time', 'TimeInstant', 'dateModified', 'dateCreated', 'Latitude', 'Longitude', 'latitude', 'longitude', 'location', 'gnss', 'pose', 'Domain', 'Mission', 'name', 'Name', 'Image', 'cmd',
];
const SHOWN_ELSEWHERE = new Set([...CONTEXT, 'heading', 'Heading', 'state', 'status', 'State', 'Status']);
const FIRST = [
  'speed', 'temperature', 'battery', 'humidity', 'relativehumidity', 'soilmoisture', 'windspeed', 'pressure', 'atmosphericpressure', 'illuminance', 'precipitation',
];
/** Larger numbers are times, epoch ms. */
const FIRST_TIME = 1e11;

/**
 * The most important attributes.
 *
 * @param {import('../core/entity.js').Entity} entity
 * @returns {{name: string, label: string, value: string, unit: string}[]} at most `max`
 */
export function keyAttributes(entity, max = 3) {
  const found = [];
  for (const [name, attribute] of Object.entries(entity.attributes)) {
    if (SHOWN_ELSEWHERE.has(name) || isOfCommand(name, attribute) || attribute.value === '' || attribute.value === null || typeof attribute.value === 'object') {
      continue;
    }
    found.push({ name, rank: rankOf(name, attribute), ...quantity(name, attribute) });
  }
  found.sort((a, b) => a.rank - b.rank || (a.name < b.name ? -1 : 1));
  return found.slice(0, max);
}

function rankOf(name, attribute) {
  const rank = FIRST.indexOf(name.toLowerCase());
  return rank >= 0 ? rank : typeof attribute.value === 'number' ? 100 : 200;
}

/** All attributes as texts. @returns {{name: string, type: string, value: string}[]} */
export function allAttributes(entity) {
  return Object.entries(entity.attributes)
    .map(([name, attribute]) => ({ name, type: attribute.type, value: wordsOf(name, attribute) }))
    .sort((a, b) => (a.name < b.name ? -1 : 1));
}

function wordsOf(name, attribute) {
  return name === 'Time' && attribute.value > FIRST_TIME ? dateTime(attribute.value) : plain(attribute.value, 2_000);
}

/** Selects the series that a card draws: the most important one that changes. */
export function lineOf(entity) {
  let best = null;
  for (const [name, points] of entity.series) {
    if (points.length < 3 || name === 'heading' || name === 'battery') {
      continue;
    }
    const rank = rankOf(name, { value: 0 }) + (points.of('values').every((each) => each === points.values[0]) ? 50 : 0);
    best = best === null || rank < best.rank ? { name, points, rank } : best;
  }
  return best;
}
