/** Converts between epoch time and local time without an offset; the hour at the end of summer time occurs twice. */
import { h } from './dom.js';
import { t } from '../texts.js';

const MINUTE = 60_000;
/** Longer than any change of the clock, and shorter than the time between two changes. */
const AFTER_A_CHANGE = 180 * MINUTE;

/** The local time, expressed as epoch ms of UTC. */
export function wallClock(time) {
  return time - new Date(time).getTimezoneOffset() * MINUTE;
}

/**
 * The time at which the local clock shows `wall`: the first of two; shifted by the change if the clock skips it. @param {number} wall see `wallClock`
 */
export function ofWallClock(wall) {
  return Date.parse(new Date(wall).toISOString().slice(0, -1));
}

/** An input for a local date and time. Browsers show those of their type `datetime-local` in a language and on a clock of their own. */
export function timeElement(attributes) {
  return h('input.time-input', { type: 'text', pattern: '\\d{4}-\\d\\d-\\d\\d[ T]\\d\\d:\\d\\d(:\\d\\d)?', placeholder: t('format.time'), title: t('format.time'), autocomplete: 'off', spellcheck: 'false', ...attributes });
}

/** Shows a time in an input for local date and time, and retains its ms and offset until the user changes the input. */
export class TimeInput {
  /** @param {HTMLInputElement} element of `timeElement` @param {boolean} last whether an ambiguous local time means the last of two */
  constructor(element, last) {
    this.element = element;
    this.last = last;
    this.shown = '';
  }

  show(time) {
    this.exact = time;
    this.element.value = new Date(wallClock(time)).toISOString().slice(0, 19).replace('T', ' ');
    this.shown = this.element.value;
  }

  /** Whether the user changed the input. */
  get isChosen() {
    return this.element.value !== this.shown;
  }

  /** Epoch ms; NaN if the input is empty. */
  get time() {
    return this.isChosen ? ofLocal(this.element.value, this.last, this.exact) : this.exact;
  }
}

/**
 * Parses the value of a `timeElement`; NaN if it is no time.
 *
 * @param {boolean} last whether an ambiguous local time means the last of two
 * @param {number} bound latest time in question if `last`, else the earliest; the other of two is taken if only it is within
 */
export function ofLocal(text, last, bound = NaN) {
  const first = Date.parse(text.trim().replace(' ', 'T'));
  const other = first + wallClock(first) - wallClock(first + AFTER_A_CHANGE) + AFTER_A_CHANGE;
  const both = wallClock(other) === wallClock(first) ? [first, other].sort((a, b) => (last ? b - a : a - b)) : [first];
  return both.find((time) => (last ? time <= bound : time >= bound)) ?? both[0];
}
