/** Creates the elements of the timeline. */
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { t } from '../texts.js';
import { SPEEDS } from './control.js';

/** @template T @param {T} Base @returns {T} with `build` */
export const Parts = (Base) => class extends Base {
  build() {
    const button = (name, symbol, act, extra = '') => h(`button.button.square${extra}`, {
      type: 'button', 'aria-label': t(`timeline.${name}`), title: t(`timeline.${name}Hint`), on: { click: act } }, icon(symbol, 18));
    this.back = button('stepBack', 'step-back', () => this.step(-1));
    this.play = button('play', 'play', () => this.toggle(), '.primary');
    this.forward = button('stepForward', 'step-forward', () => this.step(1));
    this.speed = h('select.tl-speed', { 'aria-label': t('timeline.speed'), on: { change: () => this.chooseSpeed() } },
      SPEEDS.map((speed) => h('option', { value: speed }, speed === 'max' ? t('timeline.fastest') : t('timeline.times', { speed }))));
    this.loop = button('loop', 'loop', () => this.toggleLoop(), '.quiet');
    this.mark = button('mark', 'flag', () => this.openMarker(), '.quiet');
    this.more = h('button.button.square.quiet.tl-more', { type: 'button', 'aria-expanded': 'false', 'aria-label': t('timeline.more'), on: { click: () => this.toggleDrawer() } }, icon('more', 18));
    this.replayIt = h('button.button.tl-start', { type: 'button', on: { click: () => this.startHere() } });

    this.canvas = h('canvas', { 'aria-hidden': 'true' });
    this.head = h('div.tl-head', { 'aria-hidden': 'true' });
    this.cursor = h('div.tl-cursor', { 'aria-hidden': 'true', hidden: true });
    this.edges = ['from', 'to'].map((edge) => h('div.tl-edge', { 'aria-hidden': 'true', hidden: true, data: { edge } }));
    this.tip = h('div.tl-tip.numbers', { 'aria-hidden': 'true', hidden: true });
    this.flags = h('div.tl-flags');
    this.cover = h('div.tl-cover', { hidden: true });
    this.track = h('div.tl-track', { tabindex: '0', role: 'slider', 'aria-label': t('timeline.position'), 'aria-orientation': 'horizontal' },
      this.canvas, this.cursor, this.edges, this.head, this.cover, this.tip);
    this.zooms = h('div.tl-zoom', null,
      button('zoomIn', 'plus', () => this.zoom(0.5), '.small.quiet'), button('zoomOut', 'minus', () => this.zoom(2), '.small.quiet'));
    this.time = h('strong.numbers');
    this.sub = h('span.small.muted');
    this.note = h('div.tl-note.small', { role: 'status' });
    this.offer = h('div.tl-offer', { role: 'status', hidden: true });
    replace(this,
      h('div.tl-controls', null, h('div.tl-transport', null, this.back, this.play, this.forward), h('div.tl-extras', null, this.speed, this.loop, this.mark), this.replayIt, this.more),
      h('div.tl-middle', null, this.track, this.flags), this.zooms,
      h('div.tl-info', null, this.time, this.sub), this.note, this.offer);
  }
};
