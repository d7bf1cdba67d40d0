/** The legend of symbols, and the scale bar. */
import { distance } from '../core/format.js';
import { h, replace } from '../core/dom.js';
import { t } from '../texts.js';
import { readPalette } from './palette.js';
import { trace } from './symbols.js';
import { groundScale } from './projection.js';

const MAX_BAR_WIDTH = 90;

export function legend() {
  const items = h('ul.legend-items');
  const menu = h('ul.legend-items.legend-menu', { 'aria-label': t('map.legend') }); // where there is no room on the map
  const bar = h('span.scale-bar', { 'aria-hidden': 'true' });
  const length = h('span.numbers');
  const element = h('div.map-legend', { role: 'group', 'aria-label': t('map.legend') }, items, h('span.scale', null, length, bar));
  return {
    element,
    menu,
    draw() {
      const palette = readPalette();
      [items, menu].forEach((place) => replace(place, [
        [[symbol('robot', palette['kind-robot']), symbol('robot', palette['kind-robot-2'])], t('kinds.robot')],
        [symbol('sensor', palette['kind-sensor']), t('kinds.sensor')],
        [symbol('camera', palette['kind-camera']), t('kinds.camera')],
        [symbol('attention', palette.warning), t('states.attention')],
        [symbol('sensor', palette.muted, 0.55), t('states.stale')],
        [symbol('sensor', palette.muted, 1, true), t('map.stopped')],
        [h('span.legend-line', { 'aria-hidden': 'true' }), t('map.encounter')],
      ].map(([image, words]) => h('li', null, image, words))));
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
