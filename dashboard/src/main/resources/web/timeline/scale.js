/** Which stretch of time lies between two edges in pixels, and how it zooms and pans within an extent. */
import { ofWallClock, wallClock } from '../core/local-time.js';

const SECOND = 1000;
const MINUTE = 60 * SECOND;
const HOUR = 60 * MINUTE;
const DAY = 24 * HOUR;
const STEPS = [
  SECOND, 2 * SECOND, 5 * SECOND, 10 * SECOND, 15 * SECOND, 30 * SECOND, MINUTE, 2 * MINUTE, 5 * MINUTE, 10 * MINUTE, 15 * MINUTE, 30 * MINUTE,
  HOUR, 2 * HOUR, 3 * HOUR, 6 * HOUR, 12 * HOUR, DAY, 2 * DAY, 7 * DAY, 28 * DAY,
];
const SHORTEST = 2 * SECOND;
/** Room for a label and air, px. */
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

  /** The time that there is. What was seen whole stays so while it grows. */
  setExtent(from, to) {
    const whole = this.isWhole;
    this.extent = [from, Math.max(to, from + SHORTEST)];
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

  /** @param {number} factor below 1 zooms in @param {number} x stays where it is */
  zoom(factor, x) {
    const at = this.time(x);
    const whole = this.extent[1] - this.extent[0];
    const length = Math.min(whole, Math.max(Math.min(SHORTEST, whole), this.length * factor));
    this.from = at - (x / this.width) * length;
    this.to = this.from + length;
    this.clamp();
  }

  pan(ms) {
    this.from += ms;
    this.to += ms;
    this.clamp();
  }

  /** Brings a time into view where it is not. */
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

  /** Times to write on the axis, round ones of the local clock. @returns {{step: number, times: number[]}} */
  ticks() {
    const atLeast = (this.length / this.width) * LABEL;
    const step = STEPS.find((each) => each >= atLeast) ?? Math.ceil(atLeast / (28 * DAY)) * 28 * DAY;
    // up to an hour each step is as long as the next; above it comes at the same hours of the clock, also across a change of it
    const first = Math.ceil(wallClock(this.from) / step) * step;
    const timeOf = step > HOUR ? ofWallClock : (wall) => wall - wallClock(this.from) + this.from;
    const times = [];
    for (let wall = first; timeOf(wall) <= this.to; wall += step) {
      times.push(timeOf(wall));
    }
    return { step, times };
  }
}
