/** Draws the last values of an attribute as a line, with the cursor that all charts share. */
import { clock, number } from '../core/format.js';
import { h, setText } from '../core/dom.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';

const WIDTH = 300;
const HEIGHT = 34;

export class Sparkline {
  constructor() {
    this.path = h('svg:path', { class: 'spark-line', 'vector-effect': 'non-scaling-stroke' });
    this.rule = h('svg:line', { class: 'spark-rule', y1: 0, y2: HEIGHT, 'vector-effect': 'non-scaling-stroke', visibility: 'hidden' });
    this.svg = h('svg:svg', { class: 'spark', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: 'none', role: 'img' }, this.path, this.rule);
    this.value = h('span.spark-value.numbers.small', { hidden: true });
    this.element = h('div.spark-frame', null, this.svg, this.value);
    this.svg.addEventListener('pointermove', (event) => this.point(event));
    this.svg.addEventListener('pointerleave', () => store.setCursor(null));
  }

  /**
   * @param {{name: string, points: import('../core/line.js').Line}|null} line
   * @param {{label: string, factor: number, words: string}|null} shown how its numbers are shown
   */
  draw(line, shown) {
    this.element.hidden = line === null;
    if (!line) {
      return;
    }
    const times = line.points.of('times');
    const { label, factor, words: unit } = shown;
    const values = line.points.of('values').map((value) => value * factor);
    const [min, max] = [Math.min(...values), Math.max(...values)];
    const height = Math.max(max - min, Math.abs(max) * 0.02, 1e-9);
    const from = times[0];
    const length = Math.max(1, times.at(-1) - from);
    this.shown = { times, values, from, length, unit };
    const steps = Array.from(times, (time, index) => {
      const x = (time - from) / length * WIDTH;
      const y = max === min ? HEIGHT / 2 : HEIGHT - 3 - (values[index] - min) / height * (HEIGHT - 6);
      return `${x.toFixed(1)} ${y.toFixed(1)}`;
    });
    this.path.classList.toggle('constant', max === min);
    this.path.setAttribute('d', `M${steps.join('L')}`);
    this.svg.setAttribute('aria-label', t(max === min ? 'cards.lineConstant' : 'cards.line', { label, min: number(min), max: number(max), unit, now: number(values.at(-1)) }));
    this.cursor();
  }

  point(event) {
    if (this.shown) {
      const box = this.svg.getBoundingClientRect();
      store.setCursor(this.shown.from + (event.clientX - box.left) / box.width * this.shown.length);
    }
  }

  /** Draws the shared cursor. */
  cursor() {
    const time = store.cursor;
    const inside = this.shown && time !== null && time >= this.shown.from && time <= this.shown.from + this.shown.length;
    this.rule.setAttribute('visibility', inside ? 'visible' : 'hidden');
    this.value.hidden = !inside;
    if (inside) {
      const { times, values, from, length, unit } = this.shown;
      const index = Math.max(0, times.findLastIndex((each) => each <= time));
      const x = (time - from) / length;
      this.rule.setAttribute('x1', x * WIDTH);
      this.rule.setAttribute('x2', x * WIDTH);
      setText(this.value, `${number(values[index])} ${unit} · ${clock(times[index])}`);
      this.value.classList.toggle('left', x > 0.5);
    }
  }
}
