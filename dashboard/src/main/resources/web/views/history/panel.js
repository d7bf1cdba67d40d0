/** One attribute of a device over time: its chart or table, a threshold, and its files. */
import { api } from '../../core/api.js';
import { h, setText } from '../../core/dom.js';
import { csvOf } from '../../core/csv.js';
import { download } from '../../core/download.js';
import { dateTime, duration, label, number } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { t } from '../../texts.js';
import { AttributeChart, seriesOf, wordsOf } from './chart.js';
import { PeriodPanel } from './period-panel.js';

const MINUTE = 60_000;
const MAX_ROWS = 500;

export class AttributePanel extends PeriodPanel {
  /** @param {number} place 1 or 2 @param {function()} changed is called when the user changes the threshold */
  constructor(place, changed) {
    super();
    this.changed = changed;
    this.isTable = false;
    this.heading = h('h2.cut');
    this.now = h('span.numbers.muted');
    this.chart = new AttributeChart((value) => this.showNow(value));
    this.threshold = h('input', { id: `history-threshold-${place}`, type: 'number', step: 'any', on: { input: () => { this.showThreshold(); this.changed(); } } });
    this.asTable = h('button.button.small.quiet', { type: 'button', 'aria-pressed': 'false', on: { click: () => this.toggleTable() } }, icon('table', 16), t('analyses.table'));
    this.files = ['csv', 'png'].map((kind) => h('button.button.small.quiet', { type: 'button', on: { click: () => this.save(kind) } }, icon('download', 16), t(`history.${kind}`)));
    this.limit = h('div.row', null, h('label', { for: this.threshold.id }, t('history.threshold')), this.threshold);
    this.tools = h('div.row.wrap.history-tools', null, this.limit, h('span.spacer'), h('div.row', null, this.asTable, this.files));
    this.element = h('section.panel.stack.analysis.history-panel', null, h('div.row', null, this.heading, h('span.spacer'), this.now), this.tools, this.content, this.notes);
  }

  /**
   * Reads an attribute.
   *
   * @param {{device: string, attribute: string, path: function(): string, interval: number}} request `device`: its name; `path` of the REST API, at the
   *     time of the request
   */
  load(request) {
    setText(this.heading, label(request.attribute));
    this.element.setAttribute('aria-label', label(request.attribute));
    super.load(request);
  }

  read({ path }) {
    return api.get(path());
  }

  /** Frees the chart too. */
  release() {
    this.close();
    this.chart.close();
  }

  show() {
    const { value } = this.history;
    const found = Boolean(value?.points.length || value?.changes?.length);
    this.tools.hidden = !found;
    this.showNotes(found, value ? notesOf(value) : []);
    if (found) {
      this.series = seriesOf(value);
      const { isFlag, isText } = this.series;
      const isTable = this.isTable || isText;
      this.limit.hidden = isFlag || isTable;
      this.asTable.hidden = isText;
      this.files[1].hidden = isTable;
      isTable ? this.showTable() : this.showChart();
      this.showNow(null);
    } else {
      setText(this.now, '');
      this.showNothing(value?.kind);
    }
  }

  showChart() {
    const { value } = this.history;
    const { values } = this.series;
    this.put('chart', this.chart.element);
    const [min, max] = [values.reduce((one, other) => Math.min(one, other)), values.reduce((one, other) => Math.max(one, other))];
    // a period that ends now begins where something is stored: an hour of a young farm would be a dash at its end
    const from = this.request.interval && value.since < value.to ? Math.max(value.from, Math.min(value.since, value.to - MINUTE)) : value.from;
    this.chart.show(this.series, [from, value.to], t('history.chart', {
      label: this.series.label, device: this.request.device, from: dateTime(from), to: dateTime(value.to), min: this.words(min), max: this.words(max), now: this.words(values.at(-1)),
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
      ? csvOf([['time', 'device', 'attribute', 'value', 'unit'], ...times.map((time, index) => [new Date(time), device, attribute, values[index], unit])])
      : await this.chart.picture(`${name}${unit && ` (${unit})`} · ${device}`), file);
  }
}

/** What a reader must know of the numbers. */
function notesOf({ kind, width, values, skipped }) {
  return [
    width > 0 && t('history.thinned', { values: number(values), part: duration(width) }),
    skipped > 0 && kind !== 'other' && t('history.skipped', { count: skipped }),
  ];
}
