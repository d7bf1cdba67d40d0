/** Names of fields with what is known of them: inside their outline or beside it, where they cover no symbol, and where they were before. */
import { age, temperature } from '../core/format.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { covers, isOver } from './encounters.js';
import { boxOf, isFound } from './fields.js';
import { LabelPlaces, drawText, widthOf } from './labels.js';

/** From one place that is tried to the next, px. */
const STEP = { x: 20, y: 6 };
/** From the middle of the name to the upper and lower edge of the text, px. */
const ABOVE = 9;
const BELOW = { one: 9, two: 25 };
/** A text that is not where it is said in full is placed anew after so many ms: to look everywhere takes time. */
const SEARCH_PAUSE = 500;
/** Px; on a narrower map texts are smaller and go nearer to the borders of fields. */
const NARROW = 560;
/** Px; a smaller field has no text beside it. */
const LEAST = 40;

export class FieldLabels {
  /** @param {import('./fields.js').FieldDrawing} fields */
  constructor(fields) {
    this.fields = fields;
    this.cached = new Map();
    /** The texts of the last frame: of which field, its line below the name, and where. */
    this.drawn = [];
  }

  /**
   * @param {import('./labels.js').LabelPlaces} places of what stands still; the texts are added
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
    const driving = new LabelPlaces();
    moving.forEach((box) => driving.block(...box));
    const isStill = (...box) => places.isFree(...box) && !encounters.some((each) => !isOver(each.encounter) && covers(each, ...box));
    const isFree = (...box) => isStill(...box) && !encounters.some((each) => covers(each, ...box)) && driving.isFree(...box);
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
      const place = this.placeOf(field.id, { ring, box, all, frame, margin: narrow ? 4 : 8 }, linesOf(field, now, narrow).map(measure), isFree, isStill);
      if (place) {
        this.drawn.push({ id: field.id, line: place.line, box: boxAt(place, place) });
        drawLabel(context, field, place, fonts, palette, places);
      }
    }
    context.globalAlpha = 1;
  }

  placeOf(id, area, texts, isFree, isStill) {
    const [x, y] = area.ring[0];
    const cached = this.cached.get(id);
    const previous = cached?.spot && { ...cached.spot, x: x + cached.spot.x, y: y + cached.spot.y };
    const here = previous && texts.find((text) => fits(area, previous, text, isFree));
    const now = performance.now();
    if (cached && (here === texts[0] || now - cached.searched < SEARCH_PAUSE)) {
      const text = here ?? (previous && texts.find((each) => fits(area, previous, each, isStill)));
      return text ? { ...text, ...previous } : null;
    }
    const found = search(area, texts, previous, isFree, isStill);
    this.cached.set(id, { searched: now, spot: found && { x: found.x - x, y: found.y - y, beside: found.beside } });
    return found;
  }
}

/** The longest text that has a place; the name alone only where nothing has one, and over what moves rather than not at all. */
function search(area, texts, previous, isFree, isStill) {
  const shortened = texts.length > 1 ? texts.slice(0, -1) : texts;
  const within = (free) => (text) => (previous && fits(area, previous, text, free) ? previous : inside(area, text, free));
  return first(shortened, within(isFree)) ?? first(shortened, (text) => beside(area, text, isFree)) ?? first(texts.slice(-1), within(isFree)) ?? first(texts, within(isStill));
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

/** What is written below the name, the longest first: where there is no room for it less, or nothing. */
function linesOf(field, now, narrow) {
  const average = store.averages.get(field.id);
  if (field.exclusion) {
    return [t('map.noAlarms'), ''];
  }
  if (!average) {
    return [''];
  }
  const value = temperature(average.value);
  const ago = age(now - average.time);
  const more = [average.verified ? t('map.devices', { count: average.count }) : t('map.unverified')];
  average.suspects.length && more.push(t('map.suspects', { count: average.suspects.length }));
  return [...(narrow ? [] : [[value, ...more, ago].join(' · ')]), `${value} · ${ago}`, value, ''];
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

function isShown([left, top, right, bottom], { frame }) {
  return left >= 0 && top >= 0 && right <= frame.width && bottom <= frame.height;
}

function fits(area, spot, text, isFree) {
  const box = boxAt(spot, text);
  const isWithin = spot.beside ? isApart(box, area)
    : [box[1], box[3]].every((y) => spansAt(area.ring, y).some(([left, right]) => left <= box[0] && right >= box[2]));
  return isWithin && isShown(box, area) && isFree(...box);
}

/** Near the top of an outline, where a line of it is wide enough. */
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

/** Below, above, right or left of an outline that is too small, where no other field is. */
function beside(area, text, isFree) {
  const { box: [left, top, right, bottom], frame } = area;
  if (right - left < LEAST || bottom - top < LEAST || !isShown(area.box, area)) {
    return null;
  }
  const columns = [(left + right - text.width) / 2, left, right - text.width].map((x) => Math.max(8, Math.min(frame.width - 8 - text.width, x)));
  const y = (top + bottom - text.below + ABOVE) / 2;
  const spots = [
    ...columns.map((x) => ({ x, y: bottom + ABOVE + 4 })), ...columns.map((x) => ({ x, y: top - text.below - 4 })), { x: right + 8, y }, { x: left - 8 - text.width, y },
  ];
  const spot = spots.find((each) => {
    const box = boxAt(each, text);
    return isShown(box, area) && isApart(box, area) && isFree(...box);
  });
  return spot ? { ...spot, beside: true } : null;
}

/** Whether a box is in no field. */
function isApart([left, top, right, bottom], { all }) {
  return all.every(({ box }) => right < box[0] || left > box[2] || bottom < box[1] || top > box[3]);
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
