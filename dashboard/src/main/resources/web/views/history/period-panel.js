/** A panel with what is read of a period, which may be loading, empty or failed. */
import { h, replace, setText } from '../../core/dom.js';
import { dateTime } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { resource } from '../../core/resource.js';
import { t } from '../../texts.js';

const MINUTE = 60_000;

/** Base of the panels. A panel implements `show`, and `read`, which reads what was requested. */
export class PeriodPanel {
  constructor() {
    this.content = h('div');
    this.notes = h('p.small.muted', { role: 'status' });
  }

  /** Reads again, and then at each interval. @param {{interval: number}} request ms; 0 to read once */
  load(request) {
    this.close();
    this.request = request;
    this.history = resource('', { interval: request.interval, read: () => this.read(request) });
    this.history.on(() => this.show());
    this.show();
  }

  close() {
    this.history?.close();
    this.history = null;
  }

  /** Shows that it is loading, or why there is nothing. @param {string} empty name of the text of an empty answer */
  showNothing(empty) {
    const { error, loading } = this.history;
    this.put(loading ? 'loading' : `${empty} ${error?.message}`, loading ? h('div.skeleton.analysis-skeleton', { 'aria-busy': 'true' })
      : error ? h('p.error-note', { role: 'alert' }, icon('warning', 18), h('span', null, t('analyses.failed', { reason: error.message })), h('span.spacer'),
        h('button.button.small', { type: 'button', on: { click: () => this.load(this.request) } }, t('analyses.retry')))
        : h('div.empty', null, h('h3', null, t(`history.${empty}`)), h('p', null, t(`history.${empty}Hint`))));
  }

  put(kind, element) {
    if (this.shown !== kind) {
      this.shown = kind;
      replace(this.content, element);
    }
  }

  /** Says from when on what is shown is complete, and why no newer state could be read. @param {Array<string|false>} more sentences */
  showNotes(found, more = []) {
    const { value, error } = this.history;
    const { from, to, since } = value ?? {};
    const notes = [since >= to ? t('history.notStored') : since > from + MINUTE && t('history.since', { time: dateTime(since) }), ...more, found && error && t('analyses.failed', { reason: error.message })];
    setText(this.notes, notes.filter(Boolean).join(' '));
    this.notes.hidden = this.notes.textContent === '';
  }
}
