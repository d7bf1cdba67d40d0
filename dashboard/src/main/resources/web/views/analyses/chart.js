/** Draws averages of fields over time as lines, with marks where devices were suspect. */
import uPlot from '/lib/uplot/uPlot.esm.js';
import { h, replace, setText } from '../../core/dom.js';
import { clock, temperature } from '../../core/format.js';
import { locale } from '../../core/language.js';
import { quantityOf } from '../../core/readings.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';

const HEIGHT = 260;
/** Colors of the scheme, each with its own dash pattern, so that lines can be distinguished without color. */
const LINES = [['--accent', []], ['--information', [8, 4]], ['--kind-other', [10, 4, 2, 4]], ['--muted', [2, 4]], ['--live', [5, 3]], ['--text', [1, 3]]];
/** Number of windows without an average that makes a gap. */
const GAP = 3;

export class AveragesChart {
  constructor() {
    this.legend = h('div.chart-legend', { role: 'group' });
    this.place = h('div.chart-place', { role: 'img', 'aria-label': t('analyses.chartLabel') });
    this.head = h('div.chart-head', { hidden: true, 'aria-hidden': 'true' });
    this.time = h('div.chart-time.numbers', { hidden: true, 'aria-hidden': 'true' });
    this.element = h('div.chart', null, this.legend, this.place);
    this.hidden = new Set();
    this.lines = [];
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.place);
    this.onScheme = () => this.rebuild();
    window.addEventListener('schemechange', this.onScheme);
    this.subscriptions = [store.on('cursor', () => this.follow()), store.on('clock', () => this.showHead()), store.on('selection', () => this.averages && this.show(this.averages, this.range))];
  }

  close() {
    this.observer.disconnect();
    window.removeEventListener('schemechange', this.onScheme);
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.plot?.destroy();
  }

  /** @param {import('./data.js').Average[]} averages by time @param {[number, number]} range epoch ms */
  show(averages, range) {
    const byLine = new Map();
    averages.forEach((each) => (byLine.get(each.line) ?? byLine.set(each.line, []).get(each.line)).push(each));
    const lines = [...byLine.keys()].sort();
    this.range = range;
    this.byLine = byLine;
    this.suspects = lines.map((line) => new Set(byLine.get(line).filter((each) => each.suspects.length).map((each) => each.end / 1000)));
    this.averages = averages;
    this.data = aligned(lines.map((line) => byLine.get(line)));
    this.device = deviceAt(this.data[0]);
    this.device && this.data.push(this.device.values);
    const key = `${lines} ${this.device?.id}`;
    if (key !== this.key || !this.plot) {
      this.key = key;
      this.lines = lines;
      this.rebuild();
    } else {
      this.plot.setData(this.data, false);
      this.plot.setScale('x', { min: range[0] / 1000, max: range[1] / 1000 });
    }
    this.showLegend();
    this.showHead();
  }

  nameOf(line) {
    return this.byLine.get(line)[0].name;
  }

  rebuild() {
    this.plot?.destroy();
    this.plot = null;
    if (!this.data || !this.place.isConnected || this.place.clientWidth === 0) {
      return;
    }
    const style = getComputedStyle(this.element);
    const color = (name) => style.getPropertyValue(name).trim();
    const font = `12px ${color('--family')}`;
    this.colors = this.lines.map((line, index) => color(LINES[index % LINES.length][0]));
    const axis = { stroke: color('--muted'), font, grid: { stroke: color('--line'), width: 1 }, ticks: { stroke: color('--line'), width: 1, size: 4 } };
    this.plot = new uPlot({
      width: this.place.clientWidth, height: HEIGHT, legend: { show: false }, padding: [12, 28, 0, 0],
      cursor: { y: false, points: { size: 7 }, drag: { x: false, y: false } },
      scales: { x: { time: true }, y: { range: (plot, low, high) => withMargin(low, high) } },
      axes: [
        { ...axis, space: 72, size: 26, values: (plot, times) => times.map((time) => clock(time * 1000).slice(0, times.length > 1 && times[1] - times[0] < 60 ? 8 : 5)) },
        { ...axis, size: 56, values: (plot, values) => values.map((value) => `${value.toLocaleString(locale, { maximumFractionDigits: 2 })} ${t('units.celsius')}`) },
      ],
      series: [{}, ...this.lines.map((line, index) => ({
        label: this.nameOf(line), stroke: this.colors[index], width: 2, dash: LINES[index % LINES.length][1], show: !this.hidden.has(line), points: { show: false },
      })), ...(this.device ? [{ label: this.device.name, stroke: color('--text'), width: 3, points: { show: false } }] : [])],
      hooks: { draw: [(plot) => this.drawSuspects(plot, color('--warning'), color('--panel'))], setCursor: [(plot) => this.cursorMoved(plot)] },
    }, this.data, this.place);
    this.plot.setScale('x', { min: this.range[0] / 1000, max: this.range[1] / 1000 });
    this.plot.over.append(this.head, this.time);
    this.plot.over.addEventListener('mouseleave', () => store.setCursor(null));
    this.showHead();
  }

  resize() {
    if (!this.plot) {
      this.data && this.rebuild();
    } else if (this.place.clientWidth > 0 && this.place.clientWidth !== this.plot.width) {
      this.plot.setSize({ width: this.place.clientWidth, height: HEIGHT });
    }
  }

  /** Draws triangles at windows with suspect devices. */
  drawSuspects(plot, color, border) {
    const g = plot.ctx;
    const ratio = window.devicePixelRatio || 1;
    g.save();
    g.fillStyle = color;
    g.strokeStyle = border;
    g.lineWidth = ratio;
    this.lines.forEach((line, index) => {
      if (this.hidden.has(line)) {
        return;
      }
      let last = -Infinity;
      for (const time of this.suspects[index]) {
        const at = this.data[0].indexOf(time);
        const x = plot.valToPos(time, 'x', true);
        const y = plot.valToPos(this.data[index + 1][at], 'y', true);
        if (x - last < 12 * ratio || x < plot.bbox.left || x > plot.bbox.left + plot.bbox.width) {
          continue; // omits some of many adjacent ones, so that the line is visible
        }
        last = x;
        const size = 4.5 * ratio;
        g.beginPath();
        g.moveTo(x, y - size);
        g.lineTo(x + size, y + size * 0.8);
        g.lineTo(x - size, y + size * 0.8);
        g.closePath();
        g.fill();
        g.stroke();
      }
    });
    g.restore();
  }

  showLegend() {
    const key = this.lines.map((line) => `${line} ${this.nameOf(line)} ${this.hidden.has(line)} ${this.suspects.some((each) => each.size)}`).join('|') + this.device?.id;
    if (key === this.legendKey) {
      this.showValues(this.shownIndex);
      return;
    }
    this.legendKey = key;
    const focused = this.legend.contains(document.activeElement) ? [...this.legend.children].indexOf(document.activeElement) : -1;
    this.values = this.lines.map(() => h('span.numbers.muted'));
    replace(this.legend, this.lines.map((line, index) => {
      const shown = !this.hidden.has(line);
      const [name, dash] = LINES[index % LINES.length];
      const sample = h('svg:line', { x1: 0, y1: 6, x2: 26, y2: 6, 'stroke-width': 2.5, 'stroke-dasharray': dash.join(' ') });
      sample.style.stroke = `var(${name})`;
      return h('button.button.small.quiet.legend-entry', {
        type: 'button', 'aria-pressed': String(shown), 'aria-label': t('analyses.hide', { field: this.nameOf(line) }), on: { click: () => this.toggle(line) },
      }, h('svg:svg', { width: 26, height: 12, 'aria-hidden': 'true' }, sample), this.nameOf(line), this.values[index]);
    }), this.deviceEntry(), this.suspects.some((each) => each.size) && h('span.small.muted.suspect-key', null, h('span', { 'aria-hidden': 'true' }), t('analyses.suspectMark')));
    focused >= 0 && this.legend.children[focused]?.focus();
    this.showValues(this.shownIndex);
  }

  deviceEntry() {
    if (!this.device) {
      return null;
    }
    const value = h('span.numbers.muted');
    this.values.push(value);
    return h('span.legend-device', null, h('svg:svg', { width: 26, height: 12, 'aria-hidden': 'true' }, h('svg:line', { x1: 0, y1: 6, x2: 26, y2: 6, 'stroke-width': 3, stroke: 'currentColor' })), this.device.name, value);
  }

  toggle(line) {
    this.hidden.has(line) ? this.hidden.delete(line) : this.hidden.add(line);
    this.plot?.setSeries(this.lines.indexOf(line) + 1, { show: !this.hidden.has(line) });
    this.showLegend();
  }

  // --- cursor --------------------------------------------------------------------------------------------------------

  cursorMoved(plot) {
    const { left, idx } = plot.cursor;
    if (this.following) {
      return;
    }
    if (left >= 0) {
      store.setCursor(plot.posToVal(left, 'x') * 1000);
    }
    this.showValues(left >= 0 ? idx : null);
  }

  follow() {
    const { plot } = this;
    if (!plot || plot.over.matches(':hover')) {
      return;
    }
    this.following = true;
    plot.setCursor(store.cursor === null ? { left: -10, top: -10 } : { left: plot.valToPos(store.cursor / 1000, 'x'), top: 10 });
    this.showValues(store.cursor === null ? null : plot.cursor.idx);
    this.following = false;
  }

  /** Shows the averages at an index beside the names of the lines, or the newest ones. @param {number|null|undefined} index */
  showValues(index) {
    const time = this.data[0][index];
    this.shownIndex = time === undefined ? null : index;
    this.values.forEach((value, at) => setText(value, temperature(this.shownIndex === null ? this.data[at + 1].findLast(Number.isFinite) : this.data[at + 1][index])));
    this.time.hidden = this.shownIndex === null || !this.plot;
    if (!this.time.hidden) {
      setText(this.time, clock(time * 1000));
      const x = this.plot.valToPos(time, 'x');
      this.time.style.transform = `translateX(${Math.max(0, Math.min(this.plot.over.clientWidth - this.time.offsetWidth, x - this.time.offsetWidth / 2))}px)`;
    }
  }

  /** Draws the position of the replay. */
  showHead() {
    const { plot } = this;
    const shown = plot && store.isReplay;
    this.head.hidden = !shown;
    if (shown) {
      const x = plot.valToPos(store.now() / 1000, 'x');
      this.head.hidden = x < 0 || x > plot.over.clientWidth;
      this.head.style.transform = `translateX(${x}px)`;
    }
  }
}

/** A range of at least one degree, with a margin above and below. */
function withMargin(low, high) {
  if (!Number.isFinite(low) || !Number.isFinite(high)) {
    return [0, 1];
  }
  const margin = Math.max(0.5, (high - low) * 0.15);
  return [low - margin, high + margin];
}

/** The temperatures of the selected device at the ends of windows; null if none is selected, or it has no temperature. @param {number[]} times s */
function deviceAt(times) {
  const entity = store.entities.get(store.selection);
  const name = entity && [...entity.series.keys()].find((each) => each.toLowerCase() === 'temperature');
  if (!name) {
    return null;
  }
  const line = entity.series.get(name);
  const [reported, values] = [line.of('times'), line.of('values')];
  const inCelsius = (value) => value === undefined ? value : quantityOf({ ...entity.attributes[name], value }, 'TEMPERATURE');
  const at = (ms) => (ms < reported[0] ? undefined : values[reported.findLastIndex((each) => each <= ms)]);
  return { id: entity.id, name: entity.name, values: times.map((time) => inCelsius(at(time * 1000))) };
}

/** Aligns lists as uPlot expects them: null is a gap, undefined is a window of another line only. */
function aligned(lists) {
  const points = lists.map((list) => {
    const values = new Map();
    list.forEach(({ start, end, value }, index) => {
      const previous = list[index - 1];
      if (previous && end - previous.end > GAP * (end - start)) {
        values.set((previous.end + (end - start)) / 1000, null);
      }
      values.set(end / 1000, value);
    });
    return values;
  });
  const times = [...new Set(points.flatMap((each) => [...each.keys()]))].sort((one, other) => one - other);
  return [times, ...points.map((values) => times.map((time) => values.get(time)))];
}
