/** Draws fields with what was worked of them, in the colors of the page or of paper. */
import { visitRuns } from '../../core/coverage.js';
import { h } from '../../core/dom.js';
import { area, distance, percent } from '../../core/format.js';
import { t } from '../../texts.js';
import { CELL_COLORS } from '../../map/coverage.js';
import { farmsOf } from '../../map/farms.js';
import { boxOf, ringsOf } from '../../map/fields.js';
import { swatch } from '../../map/legend.js';
import { groundScale, project } from '../../map/projection.js';

/** Size of a drawing in its own units, and its margin: its text has the size of the page's if it is as wide. */
const WIDTH = 720;
const MAX_HEIGHT = 480;
const MARGIN = 16;
const SCALE_WIDTH = 120;

/**
 * One drawing for each farm: fields far from each other would be dots in one.
 *
 * @param {Object[]} fields with their geometry @param {import('../../core/coverage.js').Coverage[]} coverages with figures @param {import('../../core/coverage.js').Coverage[]} layers @returns {Element[]}
 */
export function mapsOf(fields, coverages, layers) {
  const drawn = fields.map((field) => ({ field, rings: ringsOf(field.geometry) })).filter(({ rings }) => rings.length);
  const shown = (id) => coverages.find(({ field }) => field === id)?.figures;
  const farms = farmsOf(drawn.map(({ field, rings }) => ({ field, box: boxOf(rings.flat()) })), []);
  return farms.map((farm) => {
    const parts = drawn.filter(({ field }) => farm.fields.includes(field));
    const words = parts.map(({ field }) => [field.name, shown(field.id) && `${area(shown(field.id).hectares)}, ${percent(shown(field.id).share)}`].filter(Boolean).join(': ')).join('; ');
    return h('figure.report-map', null, drawing(parts, layers.filter((each) => parts.some(({ field }) => field.id === each.field)), shown, words), legend());
  });
}

function drawing(parts, layers, figuresOf, words) {
  const [left, bottom, right, top] = boxOf(parts.flatMap(({ rings }) => rings.flat()));
  const scale = Math.min((WIDTH - 2 * MARGIN) / (right - left || 1), (MAX_HEIGHT - 2 * MARGIN) / (top - bottom || 1));
  const height = Math.round((top - bottom) * scale + 2 * MARGIN + 24);
  const x = (meters) => MARGIN + (WIDTH - 2 * MARGIN - (right - left) * scale) / 2 + (meters - left) * scale;
  const y = (meters) => MARGIN + (top - meters) * scale;
  const outline = (rings) => rings.map((ring) => `M${ring.map(([east, north]) => `${round(x(east))} ${round(y(north))}`).join('L')}Z`).join('');
  return h('svg:svg', { viewBox: `0 0 ${WIDTH} ${height}`, role: 'img', 'aria-label': t('report.mapLabel', { fields: words }) },
    parts.map(({ rings }) => h('svg:path', { class: 'report-field', d: outline(rings) })),
    layers.map(({ layer }) => cells(layer, x, y)),
    parts.map(({ rings }) => h('svg:path', { class: 'report-border', d: outline(rings) })),
    parts.map(({ field, rings }) => name(field, boxOf(rings[0]), figuresOf(field.id), x, y)),
    bar(scale, bottom, height));
}

/** One path per code, of a rectangle for each part of a run. */
function cells(layer, x, y) {
  const [west, south, east, north] = layer.box;
  const [[x0, y0], [x1, y1]] = [project(west, south), project(east, north)].map(([lon, lat]) => [x(lon), y(lat)]);
  const [width, height] = [(x1 - x0) / layer.columns, (y0 - y1) / layer.rows];
  const paths = CELL_COLORS.map(() => []);
  visitRuns(layer, (code, row, column, length) => paths[code].push(`M${round(x0 + column * width)} ${round(y0 - (row + 1) * height)}h${round(length * width)}v${round(height)}h${round(-length * width)}z`));
  return paths.map((path, code) => {
    const element = path.length > 0 && h('svg:path', { class: 'report-cells', d: path.join(''), data: { cells: CELL_COLORS[code] } });
    element && (element.style.fill = `var(--${CELL_COLORS[code]})`);
    return element;
  });
}

/** The name in the middle, and below it what was worked. */
function name(field, [left, bottom, right, top], figures, x, y) {
  const middle = round((x(left) + x(right)) / 2);
  const lines = [field.name, figures && `${area(figures.hectares)} · ${percent(figures.share)}`].filter(Boolean);
  return h('svg:text', { x: middle, y: round((y(bottom) + y(top)) / 2), 'text-anchor': 'middle', class: 'report-name' }, lines.map((words, line) => h('svg:tspan', { x: middle, dy: line ? '1.3em' : 0 }, words)));
}

/** A scale of a round length. */
function bar(scale, south, height) {
  const lat = 360 / Math.PI * Math.atan(Math.exp(south / 6_378_137)) - 90;
  const meters = SCALE_WIDTH / scale * groundScale(lat);
  const power = 10 ** Math.floor(Math.log10(meters));
  const length = [5, 2, 1].map((each) => each * power).find((each) => each <= meters) ?? power;
  const width = round(SCALE_WIDTH * length / meters);
  return [
    h('svg:path', { class: 'report-scale', d: `M${MARGIN} ${height - 14}v8h${width}v-8` }),
    h('svg:text', { class: 'report-name', x: MARGIN + width + 8, y: height - 6 }, distance(length).replace(/[.,]0(?=\s)/, '')),
  ];
}

function legend() {
  return h('figcaption', null, h('ul.report-legend', null, CELL_COLORS.filter(Boolean).map((each) => h('li', null, swatch(each), t(`map.cells.${each}`)))));
}

function round(value) {
  return Math.round(value * 100) / 100;
}
