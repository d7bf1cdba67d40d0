/** Shows the fields of the farm as a table; renames, ends and deletes them. */
import { dateOf } from '../../core/csv.js';
import { dateTime } from '../../core/format.js';
import { h } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { askEnd, deleteField, renameField } from '../../core/field-changes.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { formRow, openDialog } from '../../core/dialog.js';

/** Of fields, for their CSV. */
export const COLUMNS = [
  { name: 'missions.fieldColumns.field', value: ({ name }) => name },
  { name: 'report.id', value: ({ id }) => id },
  { name: 'missions.fieldColumns.domain', value: ({ properties }) => properties.Domain },
  { name: 'missions.fieldColumns.kind', value: ({ exclusion }) => t(exclusion ? 'missions.zone' : 'missions.field') },
  { name: 'draw.crop', value: ({ properties }) => properties.crop },
  { name: 'missions.fieldColumns.from', value: ({ validFrom }) => (validFrom > 0 ? dateOf(validFrom) : null) },
];

/** @param {object[]} fields of the store, in the order of the rows */
export function fieldTable(fields) {
  const columns = ['field', 'domain', 'kind', 'from'];
  return h('div.table-frame', { tabindex: '0', role: 'group', 'aria-label': t('missions.fields') }, h('table.table.field-table', null,
    h('thead', null, h('tr', null, columns.map((name) => h('th', { scope: 'col', class: name === 'from' ? 'numbers' : '' }, t(`missions.fieldColumns.${name}`))), store.may('operate') && h('td'))),
    h('tbody', null, fields.map(row))));
}

function row(field) {
  return h('tr', null,
    h('th', { scope: 'row' }, field.name, field.name !== field.id && h('span.small.muted', null, ` ${field.id}`)),
    domainOf(field.properties.Domain),
    h('td', null, [t(field.exclusion ? 'missions.zone' : 'missions.field'), typeof field.properties.crop === 'string' && field.properties.crop].filter(Boolean).join(' · ')),
    h('td.numbers', null, field.validFrom > 0 ? dateTime(field.validFrom) : t('missions.always')),
    store.may('operate') && h('td.acts', null, act(field, 'rename', 'pencil', rename), act(field, 'end', 'stop', askEnd), store.may('administer') && act(field, 'delete', 'trash', remove)));
}

/** Marks a domain that does not exist, since it was deleted or is misspelled in the file. */
function domainOf(domain) {
  const isLost = domain && !store.lists.domains.loading && !store.lists.domains.error && !store.domains.has(domain);
  return h('td', { class: isLost ? 'warn' : '' }, isLost ? t('missions.lostDomain', { domain }) : domain ?? '–');
}

function act(field, name, symbol, work) {
  const words = t(`missions.fieldActs.${name}`, { field: field.name });
  return h('button.button.quiet.square', { type: 'button', 'aria-label': words, title: words, data: { act: `${name} ${field.id}` }, on: { click: () => work(field, words) } }, icon(symbol, 18));
}

function rename(field, title) {
  const name = h('input', { required: true, maxlength: 200, autocomplete: 'off', value: field.name });
  openDialog({
    title, submit: t('missions.rename'), body: [formRow(t('missions.name'), name, t('missions.renameHint'))],
    work: () => renameField(field, name.value),
  });
  name.select();
}

function remove(field, title) {
  openDialog({
    title: `${title}?`, submit: t('missions.delete'), danger: true, body: [h('p', null, t('missions.deleteFieldText'))],
    work: () => deleteField(field),
  });
}
