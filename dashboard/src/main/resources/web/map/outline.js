/** Checks outlines of fields, and writes them as text. */
import { isOnMap } from './projection.js';

/** Maximum number of corners: each pair of sides is compared. */
const MAX_CORNERS = 5_000;

/** The rings of a Polygon or MultiPolygon, each without the corner that closes it. @returns {number[][][]} */
export function ringsOf({ type, coordinates }) {
  return (type === 'Polygon' ? [coordinates] : coordinates).flat().map((ring) => (ring.length > 1 && isSame(ring[0], ring.at(-1)) ? ring.slice(0, -1) : ring));
}

/**
 * Finds why an outline cannot be the border of a field.
 *
 * @param {Object} geometry GeoJSON
 * @returns {{text: string, at: number[]|null}|null} a text of `draw.faults`, and the place as longitude and latitude
 */
export function faultOf(geometry) {
  const rings = ringsOf(geometry);
  const outside = rings.flat().find(([lon, lat]) => !isOnMap(lon, lat));
  if (outside) {
    return { text: 'outside', at: null };
  }
  if (rings.some((ring) => ring.filter((corner, index) => ring.findIndex((each) => isSame(each, corner)) === index).length < 3)) {
    return { text: 'corners', at: null };
  }
  if (rings.flat().length > MAX_CORNERS) {
    return { text: 'many', at: null };
  }
  const at = crossingOf(rings);
  return at && { text: 'crosses', at };
}

/** The first place at which two sides meet that are not neighbors. @param {number[][][]} rings */
function crossingOf(rings) {
  const sides = rings.flatMap((ring, number) => ring.map((from, index) => ({ from, to: ring[(index + 1) % ring.length], number, index, count: ring.length })));
  for (let i = 0; i < sides.length; i++) {
    for (let j = i + 1; j < sides.length; j++) {
      const [one, other] = [sides[i], sides[j]];
      const isNext = one.number === other.number && (other.index === one.index + 1 || (one.index === 0 && other.index === one.count - 1));
      const at = isNext ? foldOf(one, other) : meeting(one, other);
      if (at) {
        return at;
      }
    }
  }
  return null;
}

/** The corner at which a side lies on the one before it. */
function foldOf(one, other) {
  const [before, after] = isSame(one.to, other.from) ? [one, other] : [other, one];
  const [ax, ay, bx, by] = [before.from[0] - before.to[0], before.from[1] - before.to[1], after.to[0] - after.from[0], after.to[1] - after.from[1]];
  return turn(before.to, before.from, after.to) === 0 && ax * bx + ay * by > 0 ? before.to : null;
}

function meeting({ from: a, to: b }, { from: c, to: d }) {
  if (Math.max(a[0], b[0]) < Math.min(c[0], d[0]) || Math.max(c[0], d[0]) < Math.min(a[0], b[0]) || Math.max(a[1], b[1]) < Math.min(c[1], d[1]) || Math.max(c[1], d[1]) < Math.min(a[1], b[1])) {
    return null;
  }
  const [ca, cb, ac, ad] = [turn(c, d, a), turn(c, d, b), turn(a, b, c), turn(a, b, d)];
  if (ca * cb > 0 || ac * ad > 0) {
    return null;
  }
  const share = ca === cb ? 0 : ca / (ca - cb);
  return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
}

/** Positive if c is left of the line from a to b, 0 if it is on it. */
function turn(a, b, c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

function isSame(a, b) {
  return a[0] === b[0] && a[1] === b[1];
}

/** The direction of the longest side, degrees clockwise from north, 0 to 179. */
export function longestDirection(geometry) {
  let [longest, direction] = [-1, 0];
  for (const ring of ringsOf(geometry)) {
    ring.forEach(([lon, lat], index) => {
      const [toLon, toLat] = ring[(index + 1) % ring.length];
      const [x, y] = [(toLon - lon) * Math.cos(lat * Math.PI / 180), toLat - lat];
      if (Math.hypot(x, y) > longest) {
        longest = Math.hypot(x, y);
        direction = Math.atan2(x, y) * 180 / Math.PI;
      }
    });
  }
  return ((Math.round(direction) % 180) + 180) % 180;
}

/** Writes latitude and longitude of each corner in a line, with an empty line between rings. */
export function cornersText(geometry) {
  return geometry ? ringsOf(geometry).map((ring) => ring.map(([lon, lat]) => `${lat.toFixed(7)}, ${lon.toFixed(7)}`).join('\n')).join('\n\n') : '';
}

/**
 * Reads corners.
 *
 * @param {string} text as of `cornersText`
 * @param {Object|null} geometry whose rings they replace; null for one ring
 * @returns {{geometry: Object}|{line: number}|{rings: number}} the number of a line that is no corner; the number of rings if there should be as many
 */
export function readCorners(text, geometry) {
  const rings = [[]];
  for (const [index, line] of text.split('\n').entries()) {
    const corner = /^\s*(-?\d+(?:\.\d+)?)\s*[,;\s]\s*(-?\d+(?:\.\d+)?)\s*$/.exec(line);
    if (corner) {
      rings.at(-1).push([Number(corner[2]), Number(corner[1])]);
    } else if (line.trim()) {
      return { line: index + 1 };
    } else if (rings.at(-1).length) {
      rings.push([]);
    }
  }
  rings.at(-1).length || rings.length === 1 || rings.pop();
  const shape = geometry ?? { type: 'Polygon', coordinates: [[]] };
  const count = countRings(shape);
  if (rings.length !== count) {
    return { rings: count };
  }
  const closed = (ring) => (ring.length ? [...ring, ring[0]] : ring);
  const next = () => closed(rings.shift());
  return { geometry: { type: shape.type, coordinates: shape.type === 'Polygon' ? shape.coordinates.map(next) : shape.coordinates.map((polygon) => polygon.map(next)) } };
}

function countRings({ type, coordinates }) {
  return (type === 'Polygon' ? [coordinates] : coordinates).flat().length;
}
