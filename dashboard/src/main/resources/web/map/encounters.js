/** Encounters: who is too close to whom, and by how much. */
import { distance } from '../core/format.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { isOnMap, project } from './projection.js';

const FADING = 10_000;
/** Height of what is written above a ring, with its gap, and half of its width, px. */
const PILL = 26;
const HALF_PILL = 64;
/** How long after its moment a prediction that did not come true stays, ms: nothing says that it is over. */
const PREDICTION_STAYS = 3_000;

/**
 * @param {function(string): ({x: number, y: number}|undefined)} spotOf where a device is drawn
 * @returns {Object[]} the encounters that are drawn: where, how large, and how they look
 */
export function placeEncounters(frame, palette, spotOf) {
  const placed = [];
  for (const encounter of store.encounters.values()) {
    const from = spotOf(encounter.a) ?? reported(frame, encounter.at[0]);
    const to = spotOf(encounter.b) ?? reported(frame, encounter.at[1]);
    const style = styleOf(encounter, palette);
    if (from && to && style.alpha > 0) {
      const radius = Math.max(26, Math.hypot(to.x - from.x, to.y - from.y) / 2 + 20);
      placed.push({ encounter, from, to, x: (from.x + to.x) / 2, y: (from.y + to.y) / 2, radius, style });
    }
  }
  return placed;
}

/** Whether the ring, or the pill above it, covers a part of a box. */
export function covers({ x, y, radius }, left, top, right, bottom) {
  const half = top < y - radius ? Math.max(radius, HALF_PILL) : radius;
  return left < x + half && right > x - half && top < y + radius && bottom > y - radius - PILL;
}

/** What is over only fades: it takes no place from what is known of a field. */
export function isOver({ phase }) {
  return phase === 'ended' || phase === 'crossed';
}

function reported(frame, [lon, lat]) {
  if (!isOnMap(lon, lat)) {
    return null;
  }
  const [x, y] = project(lon, lat);
  return { x: frame.x(x, y), y: frame.y(x, y) };
}

export function drawEncounter(frame, { encounter, from, to, x, y, radius, style }, palette, places) {
  const { context } = frame;
  context.globalAlpha = style.alpha;
  context.strokeStyle = style.colour;
  context.lineWidth = 3;
  context.setLineDash(style.dash);
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
  context.lineWidth = 1.5;
  context.setLineDash([4, 4]);
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
  context.setLineDash([]);
  const above = { x, y: y - radius - 14 };
  drawPill(frame, textOf(encounter), isOver(encounter) ? [above, { x, y: y + radius + 14 }] : [above], style, palette, places);
  context.globalAlpha = 1;
}

function styleOf(encounter, palette) {
  if (encounter.phase === 'predicted' && store.now() - encounter.time > (encounter.tcpa ?? 0) * 1000 + PREDICTION_STAYS) {
    return { alpha: 0 };
  }
  if (isOver(encounter)) {
    const alpha = 0.9 * (1 - (store.now() - encounter.time) / FADING);
    return { colour: palette.muted, ink: palette.background, dash: [], alpha: Math.min(0.9, alpha) };
  }
  return encounter.phase === 'predicted'
    ? { colour: palette.warning, ink: palette.background, dash: [7, 5], alpha: 1 }
    : { colour: palette.critical, ink: palette['on-critical'], dash: [], alpha: 1 };
}

function textOf(encounter) {
  if (encounter.phase === 'predicted') {
    return t('map.predicted', { distance: distance(encounter.minDistance), time: Math.max(0, Math.round(encounter.tcpa ?? 0)) });
  }
  if (isOver(encounter)) {
    return t('map.ended', { distance: distance(encounter.minDistance) });
  }
  // once they move apart, how near they were says more than how far they are
  const current = currentDistance(encounter);
  return current > encounter.distance ? t('map.closest', { distance: distance(encounter.minDistance) }) : distance(current);
}

/** Between the newest positions, which are newer than what was told of the encounter. */
function currentDistance(encounter) {
  const [a, b] = [store.entities.get(encounter.a), store.entities.get(encounter.b)];
  if (!a?.position || !b?.position) {
    return encounter.distance;
  }
  const radians = Math.PI / 180;
  const x = (b.position[0] - a.position[0]) * Math.cos((a.position[1] + b.position[1]) / 2 * radians);
  return Math.hypot(x, b.position[1] - a.position[1]) * radians * 6_371_008.8;
}

/** At the edge of the map it stays on the map. Of several places it takes the first that is free, or none. */
function drawPill(frame, text, wanted, style, palette, places) {
  const { context } = frame;
  context.font = `700 13px ${palette.family}`;
  const half = context.measureText(text).width / 2 + 12;
  const boxes = wanted.map((place) => {
    const isInView = place.x > 0 && place.x < frame.width && place.y > -2 * PILL && place.y < frame.height;
    const x = isInView ? Math.max(half + 2, Math.min(frame.width - half - 2, place.x)) : place.x;
    const y = isInView ? Math.max(14, place.y) : place.y;
    return { x, y, box: [x - half, y - 12, x + half, y + 12] };
  });
  const place = boxes.length > 1 ? boxes.find(({ box }) => places.isFree(...box)) : boxes[0];
  if (!place) {
    return;
  }
  context.beginPath();
  context.roundRect(place.box[0], place.box[1], 2 * half, 24, 12);
  context.fillStyle = style.colour;
  context.fill();
  context.fillStyle = style.ink;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(text, place.x, place.y + 0.5);
  places.block(...place.box);
}
