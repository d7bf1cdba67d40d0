/** Draws averages of fields over time as lines, with marks where devices were suspect. */
import { h, replace, setText } from '../../core/dom.js';
import { temperature } from '../../core/format.js';
import { locale } from '../../core/language.js';
import { quantityOf } from '../../core/readings.js';
import { store } from '../../core/store.js';
import { TimeChart } from '../../core/time-chart.js';
import { t } from '../../texts.js';

/** Colors of the scheme, each with its own dash pattern, so that lines can be distinguished without color. */
const LINES = [['--accent', []], ['--information', [8, 4]], ['--kind-other', [10, 4, 2, 4]], ['--muted', [2, 4]], ['--live', [5, 3]], ['--text', [1, 3]]];
/** Number of windows without an average that makes a gap. */
const GAP = 3;

export class AveragesChart extends TimeChart {
  constructor() {
    super(t('analyses.chartLabel'));
    this.legend = h('div.chart-legend', { role: 'group' });
    this.element = h('div.chart', null, this.legend, this.place);
    this.hidden = new Set();
    this.lines = [];
    this.subscriptions.push(store.on('selection', () => this.averages && this.show(this.averages, this.range)));
  }

  /** @param {import('./data.js').Average[]} averages by time @param {[number, number]} range epoch ms */
  show(averages, range) {
    const byLine = new Map();
    averages.forEach((each) => (byLine.get(each.line) ?? byLine.set(each.line, []).get(each.line)).push(each));
    const lines = [...byLine.keys()].sort();
    this.byLine = byLine;
    this.suspects = lines.map((line) => new Set(byLine.get(line).filter((each) => each.suspects.length).map((each) => each.end / 1000)));
    this.averages = averages;
    const data = aligned(lines.map((line) => byLine.get(line)));
    this.device = deviceAt(data[0]);
    this.device && data.push(this.device.values);
    const key = `${lines} ${this.device?.id}`;
    const redesigned = key !== this.key;
    this.key = key;
    this.lines = lines;
    this.draw(data, range, redesigned);
    this.showLegend();
    this.showHead();
  }

  nameOf(line) {
    return this.byLine.get(line)[0].name;
  }

  design(color) {
    const colors = this.lines.map((line, index) => color(LINES[index % LINES.length][0]));
    return {
      y: withMargin,
      values: (value) => `${value.toLocaleString(locale, { maximumFractionDigits: 2 })} ${t('units.celsius')}`,
      series: [...this.lines.map((line, index) => ({
        label: this.nameOf(line), stroke: colors[index], width: 2, dash: LINES[index % LINES.length][1], show: !this.hidden.has(line), points: { show: false },
      })), ...(this.device ? [{ label: this.device.name, stroke: color('--text'), width: 3, points: { show: false } }] : [])],
      draw: (plot) => this.drawSuspects(plot, color('--warning'), color('--panel')),
    };
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

  /** Shows the averages at an index beside the names of the lines, or the newest ones. @param {number|null|undefined} index */
  showValues(index) {
    this.shownIndex = this.data[0][index] === undefined ? null : index;
    this.values.forEach((value, at) => setText(value, temperature(this.shownIndex === null ? this.data[at + 1].findLast(Number.isFinite) : this.data[at + 1][index])));
    this.showTime(this.shownIndex);
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
