/** Draws fields with their rows, and zones without alarms. */
import { store } from '../core/store.js';
import { groundScale, isOnMap, project } from './projection.js';

const MIN_ROW_WIDTH = 7;

export class FieldDrawing {
  constructor() {
    this.key = null;
    this.outlines = new Map();
  }

  /** The outline in meters of the projection, computed once per version of a field. */
  outlineOf(field) {
    let outline = this.outlines.get(field.id);
    if (!outline || outline.geometry !== field.geometry) {
      outline = { geometry: field.geometry, rings: ringsOf(field.geometry) };
      this.outlines.set(field.id, outline);
    }
    return outline;
  }

  /** @returns {number[]|null} min x, min y, max x, max y over fields */
  extent(fields) {
    const box = boxOf(fields.flatMap((field) => this.outlineOf(field).rings.flat()));
    return box[0] < box[2] ? box : null;
  }

  /** Redraws only if the fields or the view changed. */
  draw(frame, frameState, palette, options, version) {
    const key = `${frameState.coordinateToPixelTransform.join()} ${frame.width} ${frame.height} ${frame.ratio} ${version} ${options.rows}`;
    if (key === this.key) {
      return;
    }
    this.key = key;
    const { context, ratio } = frame;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, frame.width, frame.height);
    for (const { field, rings } of this.inView(frame)) {
      field.exclusion ? drawZone(context, rings, palette) : drawField(context, field, rings, frame, palette, options);
    }
  }

  /** The fields in view, with their rings in pixels of the frame. */
  inView(frame) {
    return store.fieldsInScope()
      .map((field) => ({ field, rings: this.outlineOf(field).rings.map((ring) => ring.map(([x, y]) => [frame.x(x, y), frame.y(x, y)])) }))
      .filter(({ rings }) => rings.length && isInView(rings, frame));
  }
}

/** Whether the field matches the search. */
export function isFound(field) {
  return store.isFound(field.name, field.id);
}

/** The rings of a GeoJSON geometry in meters of the projection. */
export function ringsOf(geometry) {
  const polygons = geometry?.type === 'Polygon' ? [geometry.coordinates] : geometry?.type === 'MultiPolygon' ? geometry.coordinates : [];
  // skips rings with a corner outside of the projection
  return polygons.flat().filter((ring) => Array.isArray(ring) && ring.length > 2 && ring.every((point) => Array.isArray(point) && isOnMap(point[0], point[1])))
    .map((ring) => ring.map(([lon, lat]) => project(lon, lat)));
}

function isInView(rings, frame) {
  const box = boxOf(rings[0]);
  return box[2] > 0 && box[3] > 0 && box[0] < frame.width && box[1] < frame.height;
}

/** @param {[number, number][]} points @returns {number[]} min x, min y, max x, max y */
export function boxOf(points) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of points) {
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

/** Distance of rows in pixels; of narrow rows only each second, fourth, … is drawn. */
function rowWidth(field, frame) {
  const spacing = Number(field.properties.rowSpacing) > 0 ? Number(field.properties.rowSpacing) : 1;
  const lat = field.geometry.coordinates.flat(2).find((each) => Array.isArray(each))?.[1] ?? field.geometry.coordinates[0]?.[0]?.[1] ?? 0;
  let pixels = spacing / (frame.resolution * groundScale(lat));
  while (pixels < MIN_ROW_WIDTH) {
    pixels *= 2;
  }
  return pixels;
}

function drawRows(context, ring, direction, width, color) {
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
  context.strokeStyle = color;
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
