/** Draws one attribute over time, with a threshold. */
import { h } from '../../core/dom.js';
import { readValue } from '../../core/entity.js';
import { displayOf, label, number, plain, word } from '../../core/format.js';
import { TimeChart, uPlot } from '../../core/time-chart.js';

/** A pause this many times longer than usual is a gap. */
const GAP = 10;
/** With more points, the line alone is drawn. */
const MAX_MARKED = 100;
const MARGIN = 0.08;

/**
 * A series as it is shown.
 *
 * @typedef {Object} Series
 * @property {string} label @property {string} unit in words @property {boolean} isFlag whether values are yes and no
 * @property {boolean} isText whether values are texts, each at its change
 * @property {number[]} times epoch ms @property {Array<number|string>} values in the unit that is shown
 */

/** @param {Object} history of the control plane @returns {Series} */
export function seriesOf({ attribute, kind, unit, points, changes }) {
  if (kind === 'text') {
    return { label: label(attribute), unit: '', isFlag: false, isText: true, times: changes.map(({ time }) => time), values: changes.map(({ value }) => plain(readValue(value), Infinity)) };
  }
  const values = points.map(({ value }) => value);
  const max = values.reduce((one, other) => Math.max(one, other), -Infinity);
  const { factor, words } = displayOf(attribute, { value: max, metadata: { unitCode: { value: unit } }, percent: max > 1 });
  const isFlag = kind === 'boolean';
  return { label: label(attribute), unit: isFlag ? '' : words, isFlag, isText: false, times: points.map(({ time }) => time), values: isFlag ? values : values.map((value) => value * factor) };
}

/** "21.5 °C", "yes". */
export function wordsOf({ unit, isFlag, isText }, value) {
  return isText ? word(value, 'reported') : isFlag ? plain(value === 1) : `${number(value)} ${unit}`.trim();
}

export class AttributeChart extends TimeChart {
  /** @param {function(number|null)} pointed is called with the index of the point under the cursor */
  constructor(pointed) {
    super('');
    this.pointed = pointed;
    this.threshold = null;
    this.element = h('div.chart', null, this.place);
  }

  /** @param {Series} series @param {[number, number]} range epoch ms @param {string} words for screen readers */
  show(series, range, words) {
    const key = JSON.stringify([series.label, series.unit, series.isFlag, series.times.length > MAX_MARKED]);
    const redesigned = key !== this.key;
    this.key = key;
    this.series = series;
    this.place.setAttribute('aria-label', words);
    this.draw(withGaps(series), range, redesigned);
  }

  /** @param {number|null} value in the unit that is shown */
  setThreshold(value) {
    this.threshold = value;
    this.plot?.setData(this.data, false);
    this.plot?.setScale('x', { min: this.range[0] / 1000, max: this.range[1] / 1000 });
  }

  design(color) {
    const { isFlag, times } = this.series;
    return {
      y: (low, high) => (isFlag ? [-0.1, 1.1] : this.extent(low, high)),
      splits: isFlag && [0, 1],
      values: (value) => (isFlag ? plain(value === 1) : number(value)),
      series: [{
        stroke: color('--accent'), width: 2, points: { show: times.length <= MAX_MARKED, size: 5 }, ...(isFlag && { paths: uPlot.paths.stepped({ align: 1 }) }),
      }],
      draw: (plot) => this.drawThreshold(plot, color('--warning')),
    };
  }

  /** The threshold is always in sight. */
  extent(low, high) {
    const bounds = [low, high, this.threshold].filter(Number.isFinite);
    if (!bounds.length) {
      return [0, 1];
    }
    const [min, max] = [Math.min(...bounds), Math.max(...bounds)];
    const margin = max === min ? Math.max(1, Math.abs(max) * MARGIN) : (max - min) * MARGIN;
    return [min - margin, max + margin];
  }

  drawThreshold(plot, color) {
    if (this.threshold === null) {
      return;
    }
    const g = plot.ctx;
    const ratio = window.devicePixelRatio || 1;
    const y = plot.valToPos(this.threshold, 'y', true);
    g.save();
    g.strokeStyle = color;
    g.lineWidth = 2 * ratio;
    g.setLineDash([6 * ratio, 4 * ratio]);
    g.beginPath();
    g.moveTo(plot.bbox.left, y);
    g.lineTo(plot.bbox.left + plot.bbox.width, y);
    g.stroke();
    g.restore();
  }

  showValues(index) {
    const shown = Number.isFinite(this.data[1][index]) ? index : null;
    this.showTime(shown);
    this.pointed(shown === null ? null : this.data[1][index]);
  }

  /** The chart as a picture with a title, on the color of the panel. @returns {Promise<Blob>} */
  picture(title) {
    const chart = this.plot.ctx.canvas;
    const ratio = window.devicePixelRatio || 1;
    const style = getComputedStyle(this.place);
    const canvas = Object.assign(document.createElement('canvas'), { width: chart.width, height: chart.height + 32 * ratio });
    const g = canvas.getContext('2d');
    g.fillStyle = style.getPropertyValue('--panel');
    g.fillRect(0, 0, canvas.width, canvas.height);
    g.fillStyle = style.getPropertyValue('--text');
    g.font = `600 ${14 * ratio}px ${style.getPropertyValue('--family')}`;
    g.fillText(title, 12 * ratio, 22 * ratio, canvas.width - 24 * ratio);
    g.drawImage(chart, 0, 32 * ratio);
    return new Promise((resolve) => { canvas.toBlob(resolve); });
  }
}

/** Data as uPlot expects them. */
function withGaps({ times, values }) {
  const pauses = times.slice(1).map((time, index) => time - times[index]).sort((one, other) => one - other);
  const gap = GAP * Math.max(1, pauses[pauses.length >> 1] ?? 0);
  const [seconds, shown] = [[], []];
  times.forEach((time, index) => {
    if (index > 0 && time - times[index - 1] > gap) {
      seconds.push((times[index - 1] + 1) / 1000);
      shown.push(null);
    }
    seconds.push(time / 1000);
    shown.push(values[index]);
  });
  return [seconds, shown];
}
