/** Draws encounters: which devices are too close, and their distance. */
import { distancesOf, isOver } from '../core/encounter.js';
import { distance } from '../core/format.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { isOnMap, project } from './projection.js';

/** Time for which an encounter that is over is shown, ms, and the part of it, as 1 / FADE, in which it fades. */
const FADE_MILLIS = 10_000;
const FADE = 5;
/** Height of the text above a ring with its gap, and half of its width, px. */
const PILL = 26;
const HALF_PILL = 104;
/** Time for which a prediction that did not come true is shown after its time, ms: no record ends it. */
const PREDICTION_SHOWN = 3_000;

/**
 * Computes where and how encounters are drawn.
 *
 * @param {function(string): ({x: number, y: number}|undefined)} spotOf where a device is drawn
 * @returns {Object[]} position, size and style of each encounter
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

/** Whether the ring, or the text above it, covers a part of a box. */
export function covers({ x, y, radius }, left, top, right, bottom) {
  const half = top < y - radius ? Math.max(radius, HALF_PILL) : radius;
  return left < x + half && right > x - half && top < y + radius && bottom > y - radius - PILL;
}

function reported(frame, [lon, lat]) {
  if (!isOnMap(lon, lat)) {
    return null;
  }
  const [x, y] = project(lon, lat);
  return { x: frame.x(x, y), y: frame.y(x, y) };
}

/** Draws the lines of all encounters, and above them their texts. @param {Object[]} placed by {@link placeEncounters} */
export function drawEncounters(frame, placed, palette, places) {
  placed.forEach((each) => drawLines(frame.context, each));
  placed.forEach((each) => drawText(frame, each, palette, places));
  frame.context.globalAlpha = 1;
}

function drawLines(context, { from, to, x, y, radius, style }) {
  context.globalAlpha = style.alpha;
  context.strokeStyle = style.color;
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
}

function drawText(frame, { encounter, x, y, radius, style }, palette, places) {
  const above = { x, y: y - radius - 14 };
  frame.context.globalAlpha = style.alpha;
  drawPill(frame, textOf(encounter), [above, { x, y: y + radius + 14 }], style, palette, places, !isOver(encounter));
}

function styleOf(encounter, palette) {
  if (encounter.phase === 'predicted' && store.now() - encounter.time > (encounter.tcpa ?? 0) * 1000 + PREDICTION_SHOWN) {
    return { alpha: 0 };
  }
  if (isOver(encounter)) {
    // legible for most of the time
    const alpha = FADE * (1 - (store.now() - encounter.time) / FADE_MILLIS);
    return { color: palette.muted, ink: palette.background, dash: [], alpha: Math.min(1, alpha) };
  }
  return encounter.phase === 'predicted'
    ? { color: palette.warning, ink: palette.background, dash: [7, 5], alpha: 1 }
    : { color: palette.critical, ink: palette['on-critical'], dash: [], alpha: 1 };
}

function textOf(encounter) {
  if (encounter.phase === 'predicted') {
    return t('map.predicted', { distance: distance(encounter.minDistance), time: Math.max(0, Math.round(encounter.tcpa ?? 0)) });
  }
  const { now, closest } = distancesOf(encounter);
  return t(isOver(encounter) ? 'map.ended' : 'map.apart', { now: distance(now), closest: distance(closest) });
}

/** Draws a text, moved into view at the edge of the map, at the first of several positions that is free; without one, only if it must be shown. */
function drawPill(frame, text, positions, style, palette, places, isRequired) {
  const { context } = frame;
  context.font = `700 13px ${palette.family}`;
  const half = context.measureText(text).width / 2 + 12;
  const boxes = positions.map((place) => {
    const isInView = place.x > 0 && place.x < frame.width && place.y > -2 * PILL && place.y < frame.height;
    const x = isInView ? Math.max(half + 2, Math.min(frame.width - half - 2, place.x)) : place.x;
    const y = isInView ? Math.max(14, place.y) : place.y;
    return { x, y, box: [x - half, y - 12, x + half, y + 12] };
  });
  const place = boxes.find(({ box }) => places.isFree(...box)) ?? (isRequired && boxes[0]);
  if (!place) {
    return;
  }
  context.beginPath();
  context.roundRect(place.box[0], place.box[1], 2 * half, 24, 12);
  context.fillStyle = style.color;
  context.fill();
  context.fillStyle = style.ink;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(text, place.x, place.y + 0.5);
  places.block(...place.box);
}
