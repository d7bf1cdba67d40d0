/** The distances of an encounter, as the map and the alarm say them: the current one, and the smallest so far. */
import { store } from './store.js';

/** Whether an encounter has ended. */
export function isOver({ phase }) {
  return phase === 'ended' || phase === 'crossed';
}

/** The encounter of two devices, by their keys. @returns {Object|undefined} */
export function encounterOf(a, b) {
  return store.encounters.get(`${a}|${b}`) ?? store.encounters.get(`${b}|${a}`);
}

/** @returns {{now: number, closest: number}} meters. The newest positions are newer than the record of the encounter */
export function distancesOf(encounter) {
  const now = currentDistance(encounter);
  return { now, closest: isOver(encounter) ? encounter.minDistance : Math.min(encounter.minDistance, now) };
}

function currentDistance(encounter) {
  const [a, b] = [store.entities.get(encounter.a), store.entities.get(encounter.b)];
  if (!a?.position || !b?.position) {
    return encounter.distance;
  }
  const radians = Math.PI / 180;
  const x = (b.position[0] - a.position[0]) * Math.cos((a.position[1] + b.position[1]) / 2 * radians);
  return Math.hypot(x, b.position[1] - a.position[1]) * radians * 6_371_008.8;
}
