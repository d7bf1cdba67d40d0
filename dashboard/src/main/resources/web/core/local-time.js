/** Times of the local clock, as people write them: without an offset, so the hour at the end of summer time comes twice. */

const MINUTE = 60_000;
/** No change of the clock is longer, and no two of them are as close. */
const AFTER_A_CHANGE = 180 * MINUTE;

/** What the local clock shows, counted as epoch ms of UTC. */
export function wallClock(time) {
  return time - new Date(time).getTimezoneOffset() * MINUTE;
}

/** The time at which the local clock shows this, the first of two; where it skips it, as much later. @param {number} wall of `wallClock` */
export function ofWallClock(wall) {
  return Date.parse(new Date(wall).toISOString().slice(0, -1));
}

/**
 * A time in an input for the local date and time. It is exact, to the ms and in its offset, until another one is chosen in the input.
 */
export class TimeInput {
  /** @param {HTMLInputElement} element of type `datetime-local` @param {boolean} last of two times that are written alike, whether the last is meant */
  constructor(element, last) {
    this.element = element;
    this.last = last;
    this.shown = '';
  }

  show(time) {
    this.exact = time;
    this.element.value = new Date(wallClock(time)).toISOString().slice(0, 19);
    this.shown = this.element.value;
  }

  /** Whether what is in the input is not what was shown in it. */
  get isChosen() {
    return this.element.value !== this.shown;
  }

  /** Epoch ms; NaN where the input holds none. */
  get time() {
    return this.isChosen ? ofLocal(this.element.value, this.last) : this.exact;
  }
}

/** @param {string} text of `datetime-local` @param {boolean} last of two times that are written alike, whether the last is meant */
export function ofLocal(text, last) {
  const first = Date.parse(text);
  const other = first + wallClock(first) - wallClock(first + AFTER_A_CHANGE) + AFTER_A_CHANGE;
  return last && wallClock(other) === wallClock(first) ? Math.max(first, other) : first;
}
