/** Draws lines over time, with the cursor that all charts share and the position of the replay. */
import uPlot from '/lib/uplot/uPlot.esm.js';
import { h, setText } from './dom.js';
import { clock, day } from './format.js';
import { store } from './store.js';

const HEIGHT = 260;
const DAY = 86_400;

export { uPlot };

/** Base of charts. A chart implements `design` and `showValues`. */
export class TimeChart {
  /** @param {string} label of the chart for screen readers */
  constructor(label) {
    this.place = h('div.chart-place', { role: 'img', 'aria-label': label });
    this.head = h('div.chart-head', { hidden: true, 'aria-hidden': 'true' });
    this.time = h('div.chart-time.numbers', { hidden: true, 'aria-hidden': 'true' });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.place);
    this.onScheme = () => this.rebuild();
    window.addEventListener('schemechange', this.onScheme);
    this.subscriptions = [store.on('cursor', () => this.follow()), store.on('clock', () => this.showHead())];
  }

  close() {
    this.observer.disconnect();
    window.removeEventListener('schemechange', this.onScheme);
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.plot?.destroy();
  }

  /**
   * Draws data as uPlot expects them.
   *
   * @param {number[][]} data times, s, and a list of numbers for each line; null is a gap @param {[number, number]} range epoch ms
   * @param {boolean} redesigned whether lines or units changed
   */
  draw(data, range, redesigned) {
    this.data = data;
    this.range = range;
    if (redesigned || !this.plot) {
      this.rebuild();
    } else {
      this.plot.setData(data, false);
      this.plot.setScale('x', { min: range[0] / 1000, max: range[1] / 1000 });
    }
  }

  rebuild() {
    this.plot?.destroy();
    this.plot = null;
    if (!this.data || !this.place.isConnected || this.place.clientWidth === 0) {
      return;
    }
    const style = getComputedStyle(this.place);
    const color = (name) => style.getPropertyValue(name).trim();
    const axis = { stroke: color('--muted'), font: `12px ${color('--family')}`, grid: { stroke: color('--line'), width: 1 }, ticks: { stroke: color('--line'), width: 1, size: 4 } };
    const { y, values, splits, series, draw } = this.design(color);
    this.plot = new uPlot({
      width: this.place.clientWidth, height: HEIGHT, legend: { show: false }, padding: [12, 28, 0, 0],
      cursor: { y: false, points: { size: 7 }, drag: { x: false, y: false } },
      scales: { x: { time: true }, y: { range: (plot, low, high) => y(low, high) } },
      axes: [
        { ...axis, space: 72, size: 26, values: (plot, times) => timeWords(times, plot.scales.x) },
        { ...axis, size: 56, values: (plot, numbers) => numbers.map(values), ...(splits && { splits: () => splits }) },
      ],
      series: [{}, ...series],
      hooks: { draw: [draw], setCursor: [(plot) => this.cursorMoved(plot)] },
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

  /** Shows the time at an index above the cursor; null hides it. */
  showTime(index) {
    this.time.hidden = index === null || !this.plot;
    if (!this.time.hidden) {
      const time = this.data[0][index];
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

/** Times on an axis: of several days, the day at midnight. */
function timeWords(times, { min, max }) {
  const digits = times.length > 1 && times[1] - times[0] < 60 ? 8 : 5;
  return times.map((time) => {
    const words = clock(time * 1000);
    return max - min > DAY && words === '00:00:00' ? day(time * 1000) : words.slice(0, digits);
  });
}
