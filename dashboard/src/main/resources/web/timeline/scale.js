/** Maps times to pixels, and zooms and pans within an extent. */
import { ofWallClock, wallClock } from '../core/local-time.js';

const SECOND = 1000;
const MINUTE = 60 * SECOND;
const HOUR = 60 * MINUTE;
const DAY = 24 * HOUR;
const STEPS = [
  SECOND, 2 * SECOND, 5 * SECOND, 10 * SECOND, 15 * SECOND, 30 * SECOND, MINUTE, 2 * MINUTE, 5 * MINUTE, 10 * MINUTE, 15 * MINUTE, 30 * MINUTE,
  HOUR, 2 * HOUR, 3 * HOUR, 6 * HOUR, 12 * HOUR, DAY, 2 * DAY, 7 * DAY, 28 * DAY,
];
const MIN_LENGTH = 2 * SECOND;
/** Width of a label with its spacing, px. */
const LABEL = 84;

export class Scale {
  constructor() {
    this.width = 1;
    this.extent = [0, SECOND];
    [this.from, this.to] = this.extent;
  }

  get length() {
    return this.to - this.from;
  }

  get isWhole() {
    return this.from <= this.extent[0] && this.to >= this.extent[1];
  }

  /** Sets the extent. If all of it was visible, it stays so as it grows. */
  setExtent(from, to) {
    const whole = this.isWhole;
    this.extent = [from, Math.max(to, from + MIN_LENGTH)];
    whole ? ([this.from, this.to] = this.extent) : this.clamp();
  }

  showAll() {
    [this.from, this.to] = this.extent;
  }

  x(time) {
    return ((time - this.from) / this.length) * this.width;
  }

  time(x) {
    return this.from + (x / this.width) * this.length;
  }

  isShown(from, to = from) {
    return to >= this.from && from <= this.to;
  }

  /** @param {number} factor below 1 zooms in @param {number} x stays at its position */
  zoom(factor, x) {
    const at = this.time(x);
    const whole = this.extent[1] - this.extent[0];
    const length = Math.min(whole, Math.max(Math.min(MIN_LENGTH, whole), this.length * factor));
    this.from = at - (x / this.width) * length;
    this.to = this.from + length;
    this.clamp();
  }

  pan(ms) {
    this.from += ms;
    this.to += ms;
    this.clamp();
  }

  /** Pans to a time that is out of view. */
  reveal(time) {
    if (time < this.from || time > this.to) {
      this.pan(time - this.from - this.length * 0.1);
    }
  }

  clamp() {
    const length = Math.min(this.length, this.extent[1] - this.extent[0]);
    this.from = Math.min(Math.max(this.from, this.extent[0]), this.extent[1] - length);
    this.to = this.from + length;
  }

  /** Times of labels on the axis, rounded in local time. @returns {{step: number, times: number[]}} */
  ticks() {
    const minStep = (this.length / this.width) * LABEL;
    const step = STEPS.find((each) => each >= minStep) ?? Math.ceil(minStep / (28 * DAY)) * 28 * DAY;
    // steps up to an hour have equal lengths; longer ones stay at the same hours of the local clock across its changes
    const first = Math.ceil(wallClock(this.from) / step) * step;
    const timeOf = step > HOUR ? ofWallClock : (wall) => wall - wallClock(this.from) + this.from;
    const times = [];
    for (let wall = first; timeOf(wall) <= this.to; wall += step) {
      times.push(timeOf(wall));
    }
    return { step, times };
  }
}
