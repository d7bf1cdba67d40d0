/** One attribute of a device over time: its chart or table, a threshold, and its files. */
import { api } from '../../core/api.js';
import { h, replace, setText } from '../../core/dom.js';
import { csv, download } from '../../core/download.js';
import { dateTime, duration, label, number } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { resource } from '../../core/resource.js';
import { t } from '../../texts.js';
import { AttributeChart, seriesOf, wordsOf } from './chart.js';

const MINUTE = 60_000;
const MAX_ROWS = 500;

export class AttributePanel {
  /** @param {number} place 1 or 2 @param {function()} changed is called when the user changes the threshold */
  constructor(place, changed) {
    this.changed = changed;
    this.isTable = false;
    this.heading = h('h2.cut');
    this.now = h('span.numbers.muted');
    this.chart = new AttributeChart((value) => this.showNow(value));
    this.threshold = h('input', { id: `history-threshold-${place}`, type: 'number', step: 'any', on: { input: () => { this.showThreshold(); this.changed(); } } });
    this.asTable = h('button.button.small.quiet', { type: 'button', 'aria-pressed': 'false', on: { click: () => this.toggleTable() } }, icon('table', 16), t('analyses.table'));
    this.files = ['csv', 'png'].map((kind) => h('button.button.small.quiet', { type: 'button', on: { click: () => this.save(kind) } }, icon('download', 16), t(`history.${kind}`)));
    this.limit = h('div.row', null, h('label', { for: this.threshold.id }, t('history.threshold')), this.threshold);
    this.tools = h('div.row.wrap.history-tools', null, this.limit, h('span.spacer'), this.asTable, this.files);
    this.content = h('div');
    this.notes = h('p.small.muted', { role: 'status' });
    this.element = h('section.panel.stack.analysis.history-panel', null, h('div.row', null, this.heading, h('span.spacer'), this.now), this.tools, this.content, this.notes);
  }

  /**
   * Reads an attribute.
   *
   * @param {{device: string, attribute: string, path: function(): string, interval: number}} request `device`: its name; `path` of the REST API, at the
   *     time of the request
   */
  load(request) {
    this.close();
    this.request = request;
    setText(this.heading, label(request.attribute));
    this.element.setAttribute('aria-label', label(request.attribute));
    this.history = resource('', { interval: request.interval, read: () => api.get(request.path()) });
    this.history.on(() => this.show());
    this.show();
  }

  close() {
    this.history?.close();
    this.history = null;
  }

  /** Frees the chart too. */
  release() {
    this.close();
    this.chart.close();
  }

  show() {
    const { value, error, loading } = this.history;
    const found = Boolean(value?.points.length);
    this.tools.hidden = !found;
    setText(this.notes, notesOf(value, found && error));
    this.notes.hidden = this.notes.textContent === '';
    if (found) {
      this.series = seriesOf(value);
      this.limit.hidden = this.series.isFlag || this.isTable;
      this.isTable ? this.showTable() : this.showChart();
      this.files[1].hidden = this.isTable;
      this.showNow(null);
      return;
    }
    setText(this.now, '');
    const state = loading ? 'loading' : error ? 'error' : value.kind;
    this.put(`${state} ${error?.message}`, loading ? h('div.skeleton.analysis-skeleton', { 'aria-busy': 'true' })
      : error ? h('p.error-note', { role: 'alert' }, icon('warning', 18), h('span', null, t('analyses.failed', { reason: error.message })), h('span.spacer'),
        h('button.button.small', { type: 'button', on: { click: () => this.load(this.request) } }, t('analyses.retry')))
        : h('div.empty', null, h('h3', null, t(`history.${value.kind}`)), h('p', null, t(`history.${value.kind}Hint`))));
  }

  put(kind, element) {
    if (this.shown !== kind) {
      this.shown = kind;
      replace(this.content, element);
    }
  }

  showChart() {
    const { value } = this.history;
    const { values } = this.series;
    this.put('chart', this.chart.element);
    const [min, max] = [values.reduce((one, other) => Math.min(one, other)), values.reduce((one, other) => Math.max(one, other))];
    this.chart.show(this.series, [value.from, value.to], t('history.chart', {
      label: this.series.label, device: this.request.device, from: dateTime(value.from), to: dateTime(value.to), min: this.words(min), max: this.words(max), now: this.words(values.at(-1)),
    }));
    this.showThreshold();
  }

  /** Shows a table, the newest rows first. */
  showTable() {
    const { times, values } = this.series;
    const rows = times.map((time, index) => [dateTime(time), this.words(values[index])]).slice(-MAX_ROWS).reverse();
    this.put(`table ${times.length} ${times.at(-1)}`, h('div.table-frame.analysis-table', { tabindex: '0', role: 'group', 'aria-label': this.series.label }, h('table.table', null,
      h('thead', null, h('tr', null, h('th', { scope: 'col' }, t('analyses.when')), h('th.numbers', { scope: 'col' }, this.series.label))),
      h('tbody', null, rows.map(([time, words]) => h('tr', null, h('td.numbers-left', null, time), h('td.numbers', null, words)))))));
  }

  toggleTable() {
    this.isTable = !this.isTable;
    this.asTable.setAttribute('aria-pressed', String(this.isTable));
    this.show();
  }

  words(value) {
    return wordsOf(this.series, value);
  }

  /** Shows the value under the cursor, or the newest one. @param {number|null} value */
  showNow(value) {
    this.series && setText(this.now, this.words(value ?? this.series.values.at(-1)));
  }

  showThreshold() {
    const { value } = this.threshold;
    this.chart.setThreshold(value === '' || !this.series || this.series.isFlag ? null : Number(value));
  }

  async save(kind) {
    const { device, attribute } = this.request;
    const { times, values, label: name, unit } = this.series;
    const file = `${device} ${attribute} ${new Date(this.history.value.from).toISOString().slice(0, 16)}.${kind}`;
    download(kind === 'csv'
      ? csv([['time', 'device', 'attribute', 'value', 'unit'], ...times.map((time, index) => [new Date(time).toISOString(), device, attribute, values[index], unit])])
      : await this.chart.picture(`${name}${unit && ` (${unit})`} · ${device}`), file);
  }
}

/** What a reader must know of the numbers. @param {Error|null|false} error of the newest attempt, if older numbers are shown */
function notesOf(value, error) {
  if (!value) {
    return '';
  }
  const { from, to, since, width, values, skipped } = value;
  return [
    since >= to ? t('history.notStored') : since > from + MINUTE && t('history.since', { time: dateTime(since) }),
    width > 0 && t('history.thinned', { values: number(values), part: duration(width) }),
    skipped > 0 && value.kind !== 'other' && t('history.skipped', { count: skipped }),
    error && t('analyses.failed', { reason: error.message }),
  ].filter(Boolean).join(' ');
}
