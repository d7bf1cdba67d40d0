/** Draws the density of events, encounters and the axis on a canvas. */
import { clock, day } from '../core/format.js';

export const RULER = 18;
const DAY = 86_400_000;
const MIN_BAR_HEIGHT = 3;
/** Encounters closer to each other than this are drawn short, px. */
const MIN_SPACING = 24;

/** The colors of the current scheme. @param {Element} element */
export function palette(element) {
  const style = getComputedStyle(element);
  const of = (name) => style.getPropertyValue(name).trim();
  return {
    bar: of('--accent'), line: of('--line'), muted: of('--muted'), text: of('--text'), critical: of('--critical'), replay: of('--replay'),
    live: of('--live'), raised: of('--raised'), font: `${of('--font-small') || '12px'} ${of('--family') || 'sans-serif'}`,
  };
}

/** Sizes a canvas for the resolution of the screen. @returns {CanvasRenderingContext2D} in CSS pixels */
export function sharp(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const [pixels, lines] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== pixels || canvas.height !== lines) {
    canvas.width = pixels;
    canvas.height = lines;
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}

/**
 * Draws the timeline.
 *
 * @param {CanvasRenderingContext2D} g
 * @param {{scale: import('./scale.js').Scale, density: {counts: Map, width: number, highest: number}, encounters: Array, range: {from: number, to:
 *     number}|null, position: number, colors: Object, height: number, kind: 'live'|'replay'}} state
 */
export function draw(g, state) {
  const { scale, height } = state;
  g.clearRect(0, 0, scale.width, height);
  drawAxis(g, state);
  drawBars(g, state);
  drawRange(g, state);
  drawEncounters(g, state);
}

function drawAxis(g, { scale, colors, height }) {
  const { step, times } = scale.ticks();
  g.font = colors.font;
  g.textBaseline = 'middle';
  g.fillStyle = colors.muted;
  for (const time of times) {
    const x = Math.round(scale.x(time)) + 0.5;
    g.strokeStyle = colors.line;
    g.lineWidth = 1;
    g.beginPath();
    g.moveTo(x, RULER - 4);
    g.lineTo(x, height);
    g.stroke();
    const label = step >= DAY ? day(time) : step < 60_000 ? clock(time) : clock(time).slice(0, 5);
    if (x + 4 + g.measureText(label).width <= scale.width) {
      g.fillText(label, x + 4, RULER / 2);
    }
  }
}

function drawBars(g, { scale, density, position, colors, height, kind }) {
  const { counts, width, highest } = density;
  const maxHeight = (height - RULER) * 0.86;
  const bar = (width / scale.length) * scale.width;
  const gap = bar >= 4 ? 1 : 0;
  for (const [start, count] of counts) {
    if (!scale.isShown(start, start + width) || count === 0) {
      continue;
    }
    const x = scale.x(start);
    if (count === null) {
      g.globalAlpha = 1;
      g.fillStyle = colors.line;
      g.fillRect(x, height - MIN_BAR_HEIGHT, Math.max(1, bar - gap), MIN_BAR_HEIGHT);
      continue;
    }
    const barHeight = Math.max(MIN_BAR_HEIGHT, Math.sqrt(count / highest) * maxHeight);
    g.fillStyle = colors.bar;
    g.globalAlpha = kind === 'live' || start + width <= position ? 0.72 : 0.3;
    g.fillRect(x, height - barHeight, Math.max(1, bar - gap), barHeight);
  }
  g.globalAlpha = 1;
}

/** Draws the loop. */
function drawRange(g, { scale, range, colors, height }) {
  if (!range) {
    return;
  }
  const [left, right] = [scale.x(range.from), scale.x(range.to)];
  g.fillStyle = colors.replay;
  g.globalAlpha = 0.14;
  g.fillRect(left, RULER, right - left, height - RULER);
  g.globalAlpha = 1;
  g.fillRect(left, RULER - 4, right - left, 4);
}

function drawEncounters(g, { scale, encounters, colors, height }) {
  const shown = encounters.filter(({ start, end }) => scale.isShown(start, end));
  // leaves the bars visible between many encounters
  const lineHeight = shown.length * MIN_SPACING > scale.width ? (height - RULER) * 0.3 : height - RULER;
  g.fillStyle = colors.critical;
  for (const { start, end } of shown) {
    const x = Math.round(scale.x(start));
    g.fillRect(x - 1, RULER, 2, lineHeight);
    g.fillRect(x - 1, height - MIN_BAR_HEIGHT, Math.max(2, scale.x(end) - x), MIN_BAR_HEIGHT);
  }
}
