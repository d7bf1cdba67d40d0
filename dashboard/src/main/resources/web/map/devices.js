/** Draws devices with trails and names in each frame in which something changed. */
import { isOver } from '../core/encounter.js';
import { age } from '../core/format.js';
import { store } from '../core/store.js';
import { cluster, drawCluster } from './clusters.js';
import { drawEncounters, placeEncounters } from './encounters.js';
import { FieldLabels } from './field-labels.js';
import { LabelPlaces, drawText, widthOf } from './labels.js';
import { colorOf } from './palette.js';
import { isOnMap, project, projectPoint } from './projection.js';
import { SIZE, drawSymbol, shapeOf } from './symbols.js';

/** Maximum points of all trails; the more devices move, the shorter their trails. */
const TRAIL_POINTS = 6_000;
/** Time without a position that interrupts a trail, ms; of devices that report rarely five periods. */
const MIN_GAP = 20_000;
/** With more points than this, trails are redrawn only every `TRAIL_INTERVAL` ms while the map does not move. */
const FEW_POINTS = 1_500;
const TRAIL_INTERVAL = 500;
/** Maximum number of names; those that matter most are drawn. */
const MAX_LABELS = 60;
const HIT_RADIUS = 14;
/** Distance of the ring around a selected symbol, px. */
const RING = 7;
/** Devices closer than this cannot be distinguished, px. */
const SAME_SPOT = 4;
/** Width below which only the names that matter are drawn, px. */
const NARROW = 560;
/** Sizes of the corners with the map's buttons and the scale, and of the legend if there is room for it, px. */
const CONTROLS = { width: 62, height: 288 };
const SCALE = { width: 170, height: 42 };
const LEGEND = { width: 820, height: 54, from: 850 };

export class DeviceDrawing {
  constructor(fields) {
    this.fieldLabels = new FieldLabels(fields);
    this.spots = [];
    this.clusters = [];
    this.byId = new Map();
  }

  draw(frame, palette, options) {
    const { context, ratio } = frame;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, frame.width, frame.height);
    const places = new LabelPlaces();
    places.block(frame.width - CONTROLS.width, 0, frame.width, CONTROLS.height);
    const foot = frame.width < LEGEND.from ? SCALE : LEGEND;
    places.block(0, frame.height - foot.height, foot.width, frame.height);
    const inView = this.collect(frame);
    const inEncounter = devicesOfEncounters();
    const { single, clusters } = cluster(inView, (entity) => entity.id === store.selection || entity.state === 'attention' || inEncounter.has(entity.id), { x: frame.x(0, 0), y: frame.y(0, 0) });
    this.spots = single;
    this.clusters = clusters;
    const [moving, standing] = [single.filter(isRobot), single.filter((spot) => !isRobot(spot))];
    standing.forEach((spot) => places.block(...symbolBox(spot)));
    const encounters = placeEncounters(frame, palette, (id) => this.byId.get(id));
    this.fieldLabels.draw(frame, palette, places, moving.map(symbolBox), encounters);
    moving.forEach((spot) => places.block(...symbolBox(spot)));
    drawEncounters(frame, encounters, palette, places);
    for (const each of clusters) {
      each.radius = drawCluster(context, each, palette);
      places.block(each.x - each.radius, each.y - each.radius, each.x + each.radius, each.y + each.radius);
    }
    this.drawSymbols(context, single, palette, ratio);
    options.labels && this.drawLabels(frame, single, places, palette, inEncounter);
  }

  /** Returns the devices of the scope that are in view, with their pixels. */
  collect(frame) {
    const inView = [];
    this.byId.clear();
    const margin = 40;
    for (const entity of store.entities.values()) {
      if (!entity.position || !isOnMap(...entity.position) || !store.inScope(entity)) {
        continue;
      }
      if (entity.drawnFrom !== entity.position) {
        entity.drawnFrom = entity.position;
        entity.xy = project(entity.position[0], entity.position[1]);
      }
      const x = frame.x(entity.xy[0], entity.xy[1]);
      const y = frame.y(entity.xy[0], entity.xy[1]);
      const spot = { entity, x, y };
      this.byId.set(entity.id, spot);
      if (x > -margin && y > -margin && x < frame.width + margin && y < frame.height + margin) {
        inView.push(spot);
      }
    }
    return inView;
  }

  /** Draws trails on a layer of their own; many trails are not redrawn in each frame. */
  drawTrails(frame, frameState, palette, options) {
    const key = `${frameState.coordinateToPixelTransform.join()} ${frame.width} ${frame.height} ${frame.ratio} ${palette.background} ${options.trails} ${store.selection} ${store.filter} ${store.scope.domain} ${store.scope.mission}`;
    const now = performance.now();
    if (key === this.trailKey && store.entities === this.trailsOf && this.trailPoints > FEW_POINTS && now - this.trailTime < TRAIL_INTERVAL) {
      return;
    }
    Object.assign(this, { trailKey: key, trailsOf: store.entities, trailTime: now, trailPoints: 0 });
    const { context, ratio } = frame;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, frame.width, frame.height);
    if (!options.trails) {
      return;
    }
    const moving = [...store.entities.values()].filter((entity) =>
      entity.position && isOnMap(...entity.position) && store.inScope(entity) && entity.trail.length > 1 && (entity.kind === 'robot' || (entity.kind !== 'camera' && entity.trail.length > 3)));
    const length = Math.max(2, Math.min(120, Math.floor(TRAIL_POINTS / Math.max(1, moving.length))));
    context.lineCap = 'round';
    context.lineJoin = 'round';
    for (const entity of moving) {
      const chosen = entity.id === store.selection;
      const begin = chosen ? 0 : Math.max(0, entity.trail.length - length);
      this.trailPoints += entity.trail.length - begin;
      drawTrail(frame, entity.trail, begin, Math.max(MIN_GAP, 5 * (entity.period ?? 0)), colorOf(entity, palette), chosen ? 3 : 2.5, dimmed(entity) ? 0.12 : 0.55);
    }
    context.globalAlpha = 1;
  }

  drawSymbols(context, spots, palette, ratio) {
    // draws devices that need attention last, so that none covers them
    const order = { ok: 0, off: 1, stale: 2, attention: 3 };
    spots.sort((a, b) => (a.entity.kind === 'robot') - (b.entity.kind === 'robot') || order[a.entity.state] - order[b.entity.state]);
    for (const { entity, x, y } of spots) {
      const chosen = entity.id === store.selection;
      if (chosen || entity.id === store.hovered) {
        drawRing(context, x, y, SIZE[shapeOf(entity)] + RING, chosen ? palette.accent : palette.muted);
      }
      drawSymbol(context, entity, x, y, colorOf(entity, palette), palette, { ratio, alpha: dimmed(entity) ? 0.25 : 1 });
    }
  }

  drawLabels(frame, spots, places, palette, inEncounter) {
    const { context } = frame;
    const rank = ({ entity }) =>
      (entity.id === store.selection) * 32 + (entity.id === store.hovered) * 16 + inEncounter.has(entity.id) * 8 + (entity.state === 'attention') * 4 + (entity.kind === 'robot') * 2 + (entity.state !== 'stale');
    const narrow = frame.width < NARROW;
    const labeled = spots.filter(({ entity }) => !dimmed(entity) && (!narrow || rank({ entity }) > 1)).sort((a, b) => rank(b) - rank(a) || (a.entity.id < b.entity.id ? -1 : 1)).slice(0, MAX_LABELS);
    for (const { entity, x, y } of labeled) {
      const needsAttention = entity.state === 'attention';
      const stale = entity.state === 'stale';
      const text = stale ? `${entity.name} · ${age(store.now() - entity.time)}` : entity.name;
      context.font = `${needsAttention || entity.id === store.selection ? 600 : 400} ${palette.label} ${palette.family}`;
      const ring = entity.id === store.selection || entity.id === store.hovered ? RING : 0;
      const half = SIZE[shapeOf(entity)] + ring;
      // the selected device has its name in any case
      const place = places.beside(x, y, half, widthOf(context, text), frame.width) ?? (entity.id === store.selection && { x: x + half + 6, y });
      if (place) {
        drawText(context, text, place.x, place.y, needsAttention ? palette.warning : stale ? palette.muted : palette.text, palette.background);
      }
    }
  }

  /** The device at a point, or a cluster, or several devices on one spot as `spots`. */
  at(x, y) {
    const nearest = this.nearest(x, y);
    if (!nearest) {
      return this.clusters.find((each) => (each.x - x) ** 2 + (each.y - y) ** 2 <= each.radius ** 2) ?? null;
    }
    const spots = this.spots.filter((each) => (each.x - nearest.x) ** 2 + (each.y - nearest.y) ** 2 <= SAME_SPOT * SAME_SPOT);
    return spots.length > 1 ? { x: nearest.x, y: nearest.y, count: spots.length, spots } : nearest;
  }

  nearest(x, y) {
    let nearest = null;
    let minSquare = HIT_RADIUS * HIT_RADIUS;
    for (const spot of this.spots) {
      const square = (spot.x - x) ** 2 + (spot.y - y) ** 2;
      if (square <= minSquare) {
        minSquare = square;
        nearest = spot;
      }
    }
    return nearest;
  }
}

/** Devices in current encounters, which are always drawn individually. */
function devicesOfEncounters() {
  const found = new Set();
  for (const { a, b, phase } of store.encounters.values()) {
    isOver({ phase }) || found.add(a).add(b);
  }
  return found;
}

function isRobot({ entity }) {
  return entity.kind === 'robot';
}

function symbolBox({ entity, x, y }) {
  const half = SIZE[shapeOf(entity)];
  return [x - half, y - half, x + half, y + half];
}

function dimmed(entity) {
  return store.filter !== '' && !store.matches(entity);
}

/** Draws a trail in up to four parts, the older the fainter. */
function drawTrail(frame, trail, begin, gap, color, width, alpha) {
  const { context } = frame;
  context.strokeStyle = color;
  context.lineWidth = width;
  const steps = trail.length - 1 - begin;
  const parts = steps > 7 ? 4 : 1;
  for (let part = 0; part < parts; part++) {
    const from = begin + Math.floor(part * steps / parts);
    const to = begin + Math.floor((part + 1) * steps / parts);
    context.globalAlpha = alpha * (part + 1) / parts;
    context.beginPath();
    for (let i = from; i <= to; i++) {
      projectPoint(trail, i);
      const [x, y] = [frame.x(trail.x[i], trail.y[i]), frame.y(trail.x[i], trail.y[i])];
      i === from || trail.time[i] - trail.time[i - 1] > gap ? context.moveTo(x, y) : context.lineTo(x, y);
    }
    context.stroke();
  }
}

function drawRing(context, x, y, radius, color) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.lineWidth = 2;
  context.strokeStyle = color;
  context.stroke();
}
