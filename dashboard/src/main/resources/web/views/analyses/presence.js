/** Draws stays in fields as bars: one line per device, grouped by field. */
import { h, replace, setText } from '../../core/dom.js';
import { clock, duration } from '../../core/format.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { Scale } from '../../timeline/scale.js';

const MAX_LINES = 200;

export class PresenceBars {
  /** @param {function(Object)} showMoment shows the start of a stay */
  constructor(showMoment) {
    this.showMoment = showMoment;
    this.scale = new Scale();
    this.axis = h('div.gantt-axis', { 'aria-hidden': 'true' });
    this.lines = h('div.gantt-lines');
    this.head = h('div.gantt-head', { hidden: true, 'aria-hidden': 'true' });
    this.cursor = h('div.gantt-cursor', { hidden: true, 'aria-hidden': 'true' });
    this.overlay = h('div.gantt-overlay', null, this.cursor, this.head);
    this.more = h('p.small.muted', { hidden: true });
    this.element = h('div.stack', null, h('div.gantt', null, this.axis, this.lines, this.overlay), this.more);
    this.observer = new ResizeObserver(() => this.place());
    this.observer.observe(this.axis);
    this.subscriptions = [store.on('clock', () => this.marks()), store.on('cursor', () => this.marks()), store.on('selection', () => this.highlight())];
    this.lines.addEventListener('pointermove', (event) => this.hover(event));
    this.lines.addEventListener('pointerleave', () => store.setCursor(null));
  }

  close() {
    this.observer.disconnect();
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
  }

  show(stays, range) {
    this.range = range;
    const byLine = new Map();
    for (const stay of stays) {
      const key = `${stay.fieldName}\n${stay.name}\n${stay.device}`;
      byLine.has(key) || byLine.set(key, []);
      byLine.get(key).push(stay);
    }
    const lines = [...byLine.entries()].sort(([one], [other]) => one.localeCompare(other, undefined, { numeric: true })).slice(0, MAX_LINES);
    this.more.hidden = lines.length === byLine.size;
    setText(this.more, t('analyses.more', { shown: lines.length, count: byLine.size }));
    const now = store.isReplay ? Math.max(store.now(), range[0]) : range[1];
    // the bar of an open stay ends at the current time
    const drawn = [...range, stays.some(({ to }) => to === null) && now].map((time) => Math.round(time / 5_000));
    const key = JSON.stringify([lines.map(([name, each]) => [name, each.map(({ from, to }) => [from, to])]), drawn, store.may('operate')]);
    if (key === this.key) {
      this.place();
      return;
    }
    this.key = key;
    let field = null;
    const focused = document.activeElement?.dataset.stay;
    replace(this.lines, lines.map(([name, each]) => {
      const [fieldName, device] = name.split('\n');
      const title = fieldName !== field && h('div.gantt-field', null, fieldName);
      field = fieldName;
      return [title, h('div.gantt-line', { data: { device: each[0].device } }, h('span.gantt-name.cut', { title: device }, device), h('div.gantt-track', null, each.map((stay) => this.bar(stay, now))))];
    }));
    focused && this.lines.querySelector(`[data-stay="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
    this.place();
  }

  bar(stay, now) {
    const [first, last] = this.range;
    const from = Math.max(stay.from, first);
    const to = Math.min(stay.to ?? now, last);
    const words = t('analyses.stay', { device: stay.name, field: stay.fieldName, from: clock(stay.from), to: stay.to === null ? t('analyses.stillIn') : `${clock(stay.to)} · ${duration(stay.to - stay.from)}` });
    const selector = `gantt-bar${stay.to === null ? '.open' : ''}${stay.from < first ? '.before' : ''}`;
    const attributes = { data: { stay: stay.id }, title: words, 'aria-label': words };
    const bar = store.may('operate') ? h(`button.${selector}`, { type: 'button', ...attributes, on: { click: () => this.showMoment(stay) } }) : h(`span.${selector}`, { role: 'img', ...attributes });
    bar.style.left = `${(100 * (from - first)) / (last - first)}%`;
    bar.style.width = `${Math.max(0.15, (100 * Math.max(0, to - from)) / (last - first))}%`;
    return bar;
  }

  place() {
    if (!this.range || !this.axis.clientWidth) {
      return;
    }
    this.scale.width = this.axis.clientWidth;
    this.scale.extent = this.range;
    [this.scale.from, this.scale.to] = this.range;
    const { step, times } = this.scale.ticks();
    replace(this.axis, times.map((time) => {
      const label = h('span.small.numbers', null, step < 60_000 ? clock(time) : clock(time).slice(0, 5));
      label.style.transform = `translateX(${this.scale.x(time)}px)`;
      return this.scale.x(time) < this.scale.width - 40 && label;
    }));
    this.marks();
    this.highlight();
  }

  /** Highlights the device that is selected on the map. */
  highlight() {
    this.lines.querySelectorAll('.gantt-line').forEach((line) => line.classList.toggle('selected', line.dataset.device === store.selection));
  }

  marks() {
    const show = (element, time) => {
      element.hidden = time === null || !this.range || time < this.range[0] || time > this.range[1];
      element.hidden || (element.style.transform = `translateX(${this.scale.x(time)}px)`);
    };
    show(this.head, store.isReplay ? store.now() : null);
    show(this.cursor, store.cursor);
  }

  hover(event) {
    const box = this.axis.getBoundingClientRect();
    const x = event.clientX - box.left;
    x >= 0 && x <= box.width ? store.setCursor(this.scale.time(x)) : store.setCursor(null);
  }
}
