/** Draws names of fields with their averages inside or beside the outline, without covering symbols, and where they were before if possible. */
import { isOver } from '../core/encounter.js';
import { age, percent, temperature } from '../core/format.js';
import { withDifference } from '../core/identities.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { covers } from './encounters.js';
import { boxOf, isFound } from './fields.js';
import { LabelPlaces, drawText, widthOf } from './labels.js';

/** Distance between candidate positions, px. */
const STEP = { x: 20, y: 6 };
/** Distance from the middle of the name to the upper and lower edge of the text, px. */
const ABOVE = 9;
const BELOW = { one: 9, two: 25 };
/** Interval at which a better position is searched for a shortened or missing text, ms: a search takes time. */
const SEARCH_INTERVAL = 500;
/** Width below which texts are smaller and closer to the borders of fields, px. */
const NARROW = 560;
/** Minimum size of a field with a text beside it, px. */
const MIN_SIZE = 40;

export class FieldLabels {
  /** @param {import('./fields.js').FieldDrawing} fields */
  constructor(fields) {
    this.fields = fields;
    this.cached = new Map();
    /** The texts of the last frame, with field, second line and box. */
    this.drawn = [];
  }

  /**
   * Draws the labels.
   *
   * @param {import('./labels.js').LabelPlaces} places of static symbols; the texts are added
   * @param {number[][]} moving boxes of the symbols that move
   * @param {Object[]} encounters as they are drawn
   */
  draw(frame, palette, places, moving, encounters) {
    const { context } = frame;
    const view = `${frame.resolution} ${frame.rotation} ${frame.width} ${frame.height}`;
    if (view !== this.view) {
      this.view = view;
      this.cached.clear();
    }
    const narrow = frame.width < NARROW;
    const fonts = { name: `600 ${narrow ? 13 : 14}px ${palette.family}`, line: `400 12px ${palette.family}` };
    const movingPlaces = new LabelPlaces();
    moving.forEach((box) => movingPlaces.block(...box));
    const isFreeOfStatic = (...box) => places.isFree(...box) && !encounters.some((each) => !isOver(each.encounter) && covers(each, ...box));
    const isFree = (...box) => isFreeOfStatic(...box) && !encounters.some((each) => covers(each, ...box)) && movingPlaces.isFree(...box);
    const now = store.now();
    this.drawn = [];
    const all = this.fields.inView(frame).map(({ field, rings }) => ({ field, ring: rings[0], box: boxOf(rings[0]) }));
    for (const { field, ring, box } of all) {
      const measure = (line) => {
        context.font = fonts.name;
        const name = widthOf(context, field.name);
        context.font = fonts.line;
        return { line, name, below: line ? BELOW.two : BELOW.one, width: Math.max(name, widthOf(context, line)) };
      };
      const place = this.placeOf(field.id, { ring, box, all, frame, margin: narrow ? 4 : 8 }, linesOf(field, now, narrow).map(measure), isFree, isFreeOfStatic);
      if (place) {
        this.drawn.push({ id: field.id, line: place.line, box: boxAt(place, place) });
        drawLabel(context, field, place, fonts, palette, places);
      }
    }
    context.globalAlpha = 1;
  }

  placeOf(id, area, texts, isFree, isFreeOfStatic) {
    const [x, y] = area.ring[0];
    const cached = this.cached.get(id);
    const previous = cached?.spot && { ...cached.spot, x: x + cached.spot.x, y: y + cached.spot.y };
    const current = previous && texts.find((text) => fits(area, previous, text, isFree));
    const now = performance.now();
    if (cached && (current === texts[0] || now - cached.searched < SEARCH_INTERVAL)) {
      const text = current ?? (previous && texts.find((each) => fits(area, previous, each, isFreeOfStatic)));
      return text ? { ...text, ...previous } : null;
    }
    const found = search(area, texts, previous, isFree, isFreeOfStatic);
    this.cached.set(id, { searched: now, spot: found && { x: found.x - x, y: found.y - y, beside: found.beside } });
    return found;
  }
}

/** Finds a position for the longest possible text; the name alone only if no other fits, and over moving symbols rather than none. */
function search(area, texts, previous, isFree, isFreeOfStatic) {
  const shortened = texts.length > 1 ? texts.slice(0, -1) : texts;
  const within = (free) => (text) => (previous && fits(area, previous, text, free) ? previous : inside(area, text, free));
  return first(shortened, within(isFree)) ?? first(shortened, (text) => beside(area, text, isFree)) ?? first(texts.slice(-1), within(isFree)) ?? first(texts, within(isFreeOfStatic));
}

function first(texts, find) {
  for (const text of texts) {
    const spot = find(text);
    if (spot) {
      return { ...text, ...spot };
    }
  }
  return null;
}

/** Candidates for the second line, the longest first. */
function linesOf(field, now, narrow) {
  const averages = store.averagesOf(field.id);
  if (field.exclusion) {
    return [t('map.noAlarms'), ''];
  }
  const worked = store.coveragesInScope().findLast((each) => each.field === field.id && each.figures);
  const share = worked && t('map.workedShare', { share: percent(worked.figures.share) });
  if (!averages.length) {
    return worked ? [share, ''] : [''];
  }
  const sum = (part) => averages.reduce((total, each) => total + part(each), 0);
  const value = averages.map((each) => withDifference(temperature(each.value), each.difference)).join(' · ');
  const ago = age(now - Math.min(...averages.map(({ time }) => time)));
  const more = [averages.every(({ verified }) => verified) ? t('map.devices', { count: sum(({ count }) => count) }) : t('map.unverified')];
  const suspects = sum((each) => each.suspects.length);
  suspects && more.push(t('map.suspects', { count: suspects }));
  const full = [value, ...more, ago].join(' · ');
  return [...(narrow ? [] : [...(worked ? [[share, full].join(' · ')] : []), full]), ...(worked ? [`${value} · ${share}`] : []), `${value} · ${ago}`, value, ''];
}

function drawLabel(context, field, { x, y, line, name, width, beside: out }, fonts, palette, places) {
  const edge = out ? palette.background : palette.field;
  context.globalAlpha = isFound(field) ? 1 : 0.3;
  context.font = fonts.name;
  drawText(context, field.name, x, y, field.exclusion ? palette.muted : palette.text, edge);
  places.block(x - 4, y - ABOVE, x + name + 4, y + BELOW.one);
  if (line) {
    context.font = fonts.line;
    drawText(context, line, x, y + 17, palette.muted, edge);
    places.block(x - 4, y + BELOW.one, x + width + 4, y + BELOW.two);
  }
}

function boxAt({ x, y }, { width, below }) {
  return [x - 4, y - ABOVE, x + width + 4, y + below];
}

function isInView([left, top, right, bottom], { frame }) {
  return left >= 0 && top >= 0 && right <= frame.width && bottom <= frame.height;
}

function fits(area, spot, text, isFree) {
  const box = boxAt(spot, text);
  const isWithin = spot.beside ? isApart(box, area)
    : [box[1], box[3]].every((y) => spansAt(area.ring, y).some(([left, right]) => left <= box[0] && right >= box[2]));
  return isWithin && isInView(box, area) && isFree(...box);
}

/** Finds a position near the top of the outline where it is wide enough. */
function inside({ ring, box: [, top, , bottom], frame, margin }, { width, below }, isFree) {
  const to = Math.min(bottom, frame.height) - below;
  for (let y = Math.max(top, 0) + ABOVE + 4; y < to; y += STEP.y) {
    for (const [left, right] of spansAt(ring, y - ABOVE)) {
      for (const [lowLeft, lowRight] of spansAt(ring, y + below)) {
        const end = Math.min(right, lowRight, frame.width) - margin - width;
        for (let x = Math.max(left, lowLeft, 0) + margin + 4; x <= end; x += STEP.x) {
          if (isFree(...boxAt({ x, y }, { width, below }))) {
            return { x, y, beside: false };
          }
        }
      }
    }
  }
  return null;
}

/** Finds a position below, above, right or left of an outline that is too small, outside of all fields. */
function beside(area, text, isFree) {
  const { box: [left, top, right, bottom], frame } = area;
  if (right - left < MIN_SIZE || bottom - top < MIN_SIZE || !isInView(area.box, area)) {
    return null;
  }
  const columns = [(left + right - text.width) / 2, left, right - text.width].map((x) => Math.max(8, Math.min(frame.width - 8 - text.width, x)));
  const y = (top + bottom - text.below + ABOVE) / 2;
  const spots = [
    ...columns.map((x) => ({ x, y: bottom + ABOVE + 4 })), ...columns.map((x) => ({ x, y: top - text.below - 4 })), { x: right + 8, y }, { x: left - 8 - text.width, y },
  ];
  const spot = spots.find((each) => {
    const box = boxAt(each, text);
    return isInView(box, area) && isApart(box, area) && isFree(...box);
  });
  return spot ? { ...spot, beside: true } : null;
}

/** Whether a box is outside of all fields. */
function isApart([left, top, right, bottom], { all }) {
  return all.every(({ box }) => right < box[0] || left > box[2] || bottom < box[1] || top > box[3]);
}

/** Segments of a horizontal line that are inside a ring. */
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
