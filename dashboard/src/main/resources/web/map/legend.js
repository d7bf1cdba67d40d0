/** The legend of symbols, and the scale bar. */
import { distance } from '../core/format.js';
import { h } from '../core/dom.js';
import { redraw } from '../core/redraw.js';
import { t } from '../texts.js';
import { CELL_COLORS } from './coverage.js';
import { trace } from './symbols.js';
import { groundScale } from './projection.js';

const MAX_BAR_WIDTH = 90;

/** @param {function(string)} toggle shows or hides what an option names */
export function legend(toggle) {
  const items = h('ul.legend-items');
  const menu = h('ul.legend-items.legend-menu', { 'aria-label': t('map.legend') }); // where there is no room on the map
  const bar = h('span.scale-bar', { 'aria-hidden': 'true' });
  const length = h('span.numbers');
  let drawn = null;
  const element = h('div.map-legend', { role: 'group', 'aria-label': t('map.legend') }, items, h('span.scale', null, length, bar));
  return {
    element,
    menu,
    /** @param {Object<string, string>} palette @param {Object<string, boolean>} options of the map @param {boolean} hasCoverage whether anything was worked */
    draw(palette, options, hasCoverage) {
      const key = `${Object.values(palette)} ${options.coverage} ${hasCoverage}`;
      if (key === drawn) {
        return;
      }
      drawn = key;
      [items, menu].forEach((place) => redraw(place, [
        [[symbol('robot', palette['kind-robot']), symbol('robot', palette['kind-robot-2'])], t('kinds.robot')],
        [symbol('sensor', palette['kind-sensor']), t('kinds.sensor')],
        [symbol('camera', palette['kind-camera']), t('kinds.camera')],
        [symbol('attention', palette.warning), t('states.attention')],
        [symbol('sensor', palette.muted, 0.55), t('states.stale')],
        [symbol('sensor', palette.muted, 1, true), t('map.stopped')],
        [h('span.legend-line', { 'aria-hidden': 'true' }), t('map.encounter')],
      ].map(([image, words]) => h('li', null, image, words)), hasCoverage && coverageEntries(options.coverage, () => toggle('coverage'))));
    },
    scale(view) {
      const center = ol.proj.toLonLat(view.getCenter());
      const meters = view.getResolution() * groundScale(center[1]) * MAX_BAR_WIDTH;
      const power = 10 ** Math.floor(Math.log10(meters));
      const round = [5, 2, 1].map((each) => each * power).find((each) => each <= meters) ?? power;
      bar.style.width = `${Math.round(MAX_BAR_WIDTH * round / meters)}px`;
      length.textContent = distance(round).replace('.0', '');
    },
  };
}

/** The worked area can be hidden, to see the rows of a field below it. */
function coverageEntries(isShown, toggle) {
  const [first, ...others] = CELL_COLORS.filter(Boolean).map((name) => [swatch(name), t(`map.cells.${name}`)]);
  return [
    h('li', null, h('button.button.small.quiet.legend-entry', { type: 'button', title: t('map.toggleCells'), 'aria-label': t('map.toggleCells'), data: { act: 'coverage' }, 'aria-pressed': String(isShown), on: { click: toggle } }, first)),
    ...(isShown ? others.map((each) => h('li', null, each)) : []),
  ];
}

export function swatch(name) {
  const element = h('span.legend-swatch', { 'aria-hidden': 'true' });
  element.style.background = `var(--${name})`;
  return element;
}

function symbol(shape, color, alpha = 1, hollow = false) {
  const canvas = h('canvas', { width: 40, height: 40, 'aria-hidden': 'true' });
  const context = canvas.getContext('2d');
  context.translate(20, 20);
  trace(context, shape, shape === 'robot' || shape === 'attention' ? 1.3 : 1.5);
  context.globalAlpha = alpha;
  context.fillStyle = context.strokeStyle = color;
  context.lineWidth = 4;
  hollow ? context.stroke() : context.fill();
  return canvas;
}
