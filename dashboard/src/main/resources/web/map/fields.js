/** Fields with their rows, zones without alarms, and what is known of each. */
import { age, temperature } from '../core/format.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { covers } from './encounters.js';
import { groundScale, isOnMap, project } from './projection.js';
import { drawText, widthOf } from './labels.js';

const NARROWEST_ROW = 7;
/** From one place that is tried for a name to the next, px. */
const STEP = 20;
/** Px; on a narrower map texts go nearer to the borders of fields. */
const NARROW = 560;

export class FieldDrawing {
  constructor() {
    this.key = null;
    this.outlines = new Map();
  }

  /** Outlines in meters of the projection, made once for each version of a field. */
  outlineOf(field) {
    let outline = this.outlines.get(field.id);
    if (!outline || outline.geometry !== field.geometry) {
      outline = { geometry: field.geometry, rings: ringsOf(field.geometry) };
      this.outlines.set(field.id, outline);
    }
    return outline;
  }

  /** @returns {number[]|null} min x, min y, max x, max y over fields */
  extent(fields = store.fields.values()) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const field of fields) {
      for (const ring of this.outlineOf(field).rings) {
        for (const [x, y] of ring) {
          box[0] = Math.min(box[0], x);
          box[1] = Math.min(box[1], y);
          box[2] = Math.max(box[2], x);
          box[3] = Math.max(box[3], y);
        }
      }
    }
    return box[0] < box[2] ? box : null;
  }

  /** Nothing is drawn again where neither fields nor view changed. */
  draw(frame, frameState, palette, options, version) {
    const key = `${frameState.coordinateToPixelTransform.join()} ${frame.width} ${frame.height} ${frame.ratio} ${version} ${options.rows}`;
    if (key === this.key) {
      return;
    }
    this.key = key;
    const { context, ratio } = frame;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, frame.width, frame.height);
    for (const field of store.fields.values()) {
      const rings = this.outlineOf(field).rings.map((ring) => ring.map(([x, y]) => [frame.x(x, y), frame.y(x, y)]));
      if (rings.length && isInView(rings, frame)) {
        field.exclusion ? drawZone(context, rings, palette) : drawField(context, field, rings, frame, palette, options);
      }
    }
  }

  /** Names and averages; they change by time, so they are drawn with the devices. */
  drawLabels(frame, palette, places, encounters) {
    const { context } = frame;
    const now = store.now();
    const isFree = (...box) => places.isFree(...box) && !encounters.some((each) => covers(each, ...box));
    for (const field of store.fields.values()) {
      const rings = this.outlineOf(field).rings.map((ring) => ring.map(([x, y]) => [frame.x(x, y), frame.y(x, y)]));
      if (!rings.length || !isInView(rings, frame)) {
        continue;
      }
      context.font = `600 14px ${palette.family}`;
      const wide = widthOf(context, field.name);
      context.font = `400 12px ${palette.family}`;
      const [spot, line] = spotOf(context, rings[0], wide, linesOf(field, now), frame, isFree);
      if (!spot) {
        continue;
      }
      const second = widthOf(context, line);
      context.globalAlpha = isFound(field) ? 1 : 0.3;
      context.font = `600 14px ${palette.family}`;
      drawText(context, field.name, spot.x, spot.y, field.exclusion ? palette.muted : palette.text, palette.field);
      places.block(spot.x - 4, spot.y - 10, spot.x + wide + 4, spot.y + 10);
      context.font = `400 12px ${palette.family}`;
      if (line) {
        drawText(context, line, spot.x, spot.y + 18, palette.muted, palette.field);
        places.block(spot.x - 4, spot.y + 8, spot.x + second + 4, spot.y + 28);
      }
    }
    context.globalAlpha = 1;
  }
}

/** Whether the search is for this field. */
export function isFound(field) {
  return store.isFound(field.name, field.id);
}

/** What is written below the name, the longest first: where there is no room for it the value alone, or nothing. */
function linesOf(field, now) {
  const average = store.averages.get(field.id);
  if (field.exclusion) {
    return [t('map.noAlarms'), ''];
  }
  if (!average) {
    return [''];
  }
  const value = temperature(average.value);
  const parts = [value, average.verified ? t('map.devices', { count: average.count }) : t('map.unverified')];
  average.suspects.length && parts.push(t('map.suspects', { count: average.suspects.length }));
  parts.push(age(now - average.time));
  return [parts.join(' · '), value, ''];
}

function spotOf(context, ring, wide, lines, frame, isFree) {
  for (const line of lines) {
    const spot = spotIn(ring, Math.max(wide, widthOf(context, line)), line ? 28 : 10, frame, isFree);
    if (spot) {
      return [spot, line];
    }
  }
  return [null, ''];
}

function ringsOf(geometry) {
  const polygons = geometry?.type === 'Polygon' ? [geometry.coordinates] : geometry?.type === 'MultiPolygon' ? geometry.coordinates : [];
  // a ring with a corner off the map has no shape that could be drawn
  return polygons.flat().filter((ring) => Array.isArray(ring) && ring.length > 2 && ring.every((point) => Array.isArray(point) && isOnMap(point[0], point[1])))
    .map((ring) => ring.map(([lon, lat]) => project(lon, lat)));
}

function isInView(rings, frame) {
  const box = boxOf(rings[0]);
  return box[2] > 0 && box[3] > 0 && box[0] < frame.width && box[1] < frame.height;
}

function boxOf(ring) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of ring) {
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  }
  return box;
}

function trace(context, rings) {
  context.beginPath();
  for (const ring of rings) {
    ring.forEach(([x, y], index) => (index ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.closePath();
  }
}

function drawField(context, field, rings, frame, palette, options) {
  trace(context, rings);
  context.fillStyle = palette.field;
  context.fill('evenodd');
  const direction = Number(field.properties.rowDirection);
  if (options.rows && Number.isFinite(direction)) {
    context.save();
    context.clip('evenodd');
    drawRows(context, rings[0], direction, rowWidth(field, frame), palette['field-row']);
    context.restore();
    trace(context, rings);
  }
  context.lineJoin = 'round';
  context.lineWidth = 2;
  context.strokeStyle = palette['field-border'];
  context.stroke();
}

/** Pixels from row to row; of narrow ones each second, fourth, … is drawn. */
function rowWidth(field, frame) {
  const spacing = Number(field.properties.rowSpacing) > 0 ? Number(field.properties.rowSpacing) : 1;
  const lat = field.geometry.coordinates.flat(2).find((each) => Array.isArray(each))?.[1] ?? field.geometry.coordinates[0]?.[0]?.[1] ?? 0;
  let pixels = spacing / (frame.resolution * groundScale(lat));
  while (pixels < NARROWEST_ROW) {
    pixels *= 2;
  }
  return pixels;
}

function drawRows(context, ring, direction, width, colour) {
  const [left, top, right, bottom] = boxOf(ring);
  const radius = Math.hypot(right - left, bottom - top) / 2;
  context.translate((left + right) / 2, (top + bottom) / 2);
  context.rotate(direction * Math.PI / 180);
  context.beginPath();
  for (let x = -radius; x <= radius; x += width) {
    context.moveTo(x, -radius);
    context.lineTo(x, radius);
  }
  context.lineWidth = Math.min(width * 0.55, 8);
  context.strokeStyle = colour;
  context.stroke();
}

function drawZone(context, rings, palette) {
  context.save();
  trace(context, rings);
  context.clip('evenodd');
  context.globalAlpha = 0.55;
  drawRows(context, rings[0], 45, 11, palette.line);
  context.restore();
  trace(context, rings);
  context.lineWidth = 1.5;
  context.setLineDash([6, 4]);
  context.strokeStyle = palette.muted;
  context.stroke();
  context.setLineDash([]);
}

/** Where a text may begin inside an outline: near its top, where a line of it is wide enough and covers no symbol and no encounter. */
function spotIn(ring, width, below, frame, isFree) {
  const [, top, , bottom] = boxOf(ring);
  const from = Math.max(top, 0);
  const to = Math.min(bottom, frame.height);
  for (let y = from + 22; y < to - 12; y += 12) {
    const above = spansAt(ring, y - 9);
    const lower = spansAt(ring, y + below);
    for (const [left, right] of above) {
      for (const [lowLeft, lowRight] of lower) {
        const end = Math.min(right, lowRight, frame.width) - (frame.width < NARROW ? 4 : 8) - width;
        for (let x = Math.max(left, lowLeft, 0) + (frame.width < NARROW ? 6 : 14); x <= end; x += STEP) {
          if (isFree(x - 4, y - 10, x + width + 4, y + below)) {
            return { x, y, below };
          }
        }
      }
    }
  }
  return null;
}

/** Stretches of a horizontal line that are inside a ring. */
function spansAt(ring, y) {
  const crossings = [];
  for (let i = 0; i < ring.length; i++) {
    const [x1, y1] = ring[i];
    const [x2, y2] = ring[(i + 1) % ring.length];
    if ((y1 > y) !== (y2 > y)) {
      crossings.push(x1 + (y - y1) * (x2 - x1) / (y2 - y1));
    }
  }
  crossings.sort((a, b) => a - b);
  const spans = [];
  for (let i = 0; i + 1 < crossings.length; i += 2) {
    spans.push([crossings[i], crossings[i + 1]]);
  }
  return spans;
}
