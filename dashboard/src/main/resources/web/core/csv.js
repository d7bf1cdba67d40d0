/** Saves the rows of a table as CSV. */
import { h } from './dom.js';
import { download } from './download.js';
import { icon } from './icons.js';
import { t } from '../texts.js';

/** Where a spreadsheet may take a text for a formula: at its begin, and after what other spreadsheets separate columns by. */
const FORMULA = /((?:^|[;\t\r\n])[\s"]*)(?=[=+\-@＝＋－＠])/g;
const QUOTED = /[",;\r\n\t]/;
/** Spreadsheets do not recognize UTF-8 without it. */
const BYTE_ORDER_MARK = '\ufeff';

/**
 * Writes rows as RFC 4180 defines it. Numbers have a decimal point, times are in UTC as ISO 8601, and an apostrophe precedes a formula, so
 * that no spreadsheet runs it.
 *
 * @param {Array<Array<string|number|Date|null|undefined>>} rows @returns {string}
 */
export function toCsv(rows) {
  return rows.map((row) => `${row.map(cell).join(',')}\r\n`).join('');
}

/** The rows as a file. @param {Array<Array<string|number|Date|null|undefined>>} rows @returns {Blob} */
export function csvOf(rows) {
  return new Blob([BYTE_ORDER_MARK, toCsv(rows)], { type: 'text/csv;charset=utf-8' });
}

function cell(value) {
  if (typeof value === 'number') {
    return Number.isFinite(value) ? String(value) : '';
  }
  const text = value instanceof Date ? value.toISOString() : String(value ?? '').replace(FORMULA, "$1'");
  return QUOTED.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** @param {number} time epoch ms @returns {Date|null} null if it is unknown */
export function dateOf(time) {
  return Number.isFinite(time) ? new Date(time) : null;
}

/**
 * A button that saves all rows of a table.
 *
 * @param {string} table what it is called, for screen readers @param {string} file its name without `.csv`
 * @param {import('./table.js').Column[]} columns @param {function(): Object[]} rows
 */
export function csvButton(table, file, columns, rows) {
  const click = () => {
    const written = columns.filter(({ value }) => value);
    const names = written.map(({ name, unit }) => (unit ? `${t(name)} (${t(`units.${unit}`)})` : t(name)));
    download(csvOf([names, ...rows().map((row) => written.map(({ value }) => value(row)))]), `${file}.csv`);
  };
  return h('button.button.small.quiet.csv', { type: 'button', data: { act: `csv ${file}` }, title: t('app.csv'), 'aria-label': t('app.csvOf', { table }), on: { click } }, icon('download', 16), 'CSV');
}
