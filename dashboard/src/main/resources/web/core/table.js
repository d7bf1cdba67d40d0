/** Shows rows as a table. */
import { h } from './dom.js';
import { t } from '../texts.js';

/**
 * A column of a table, and of its CSV.
 *
 * @typedef {Object} Column
 * @property {string} name of a text
 * @property {(function(Object): string)=} words of a row, for the page; without them the column is only in the CSV
 * @property {(function(Object): (string|number|Date|null))=} value of a row, for the CSV; without it the column is only on the page
 * @property {string=} unit of the values, a name of the texts @property {boolean=} isNumber
 */

/** A column whose values are its words. @returns {Column} */
export function textColumn(name, words) {
  return { name, words, value: words };
}

/** A column of numbers. @returns {Column} */
export function numberColumn(name, unit, value, format) {
  return { name, unit, value, words: (row) => format(value(row)), isNumber: true };
}

/** @param {string} name of the table, for screen readers @param {Column[]} columns @param {Object[]} rows */
export function tableOf(name, columns, rows) {
  const shown = columns.filter(({ words }) => words);
  const kind = ({ isNumber }) => (isNumber ? 'numbers' : '');
  return h('div.table-frame', { tabindex: '0', role: 'group', 'aria-label': name }, h('table.table', null,
    h('thead', null, h('tr', null, shown.map((each) => h('th', { scope: 'col', class: kind(each) }, t(each.name))))),
    h('tbody', null, rows.map((row) => h('tr', null, shown.map((each) => h('td', { class: kind(each) }, each.words(row))))))));
}
