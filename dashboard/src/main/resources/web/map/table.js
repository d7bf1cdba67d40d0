/** Shows the content of the map as tables. */
import { csvButton, dateOf } from '../core/csv.js';
import { age, area, distance, duration, number, percent, shortId, temperature } from '../core/format.js';
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { withDifference } from '../core/identities.js';
import { store } from '../core/store.js';
import { numberColumn, textColumn } from '../core/table.js';
import { t } from '../texts.js';
import { isOnMap } from './projection.js';

const COLUMNS = ['name', 'kind', 'state', 'position', 'speed', 'age'];
const NUMBERS = new Set(['position', 'speed', 'age']);
const MAX_ROWS = 500;
const REDRAW_MILLIS = 1_000;

export function mapTables(onClose) {
  let sorted = 'name';
  let down = false;
  let waiting = null;
  const body = h('tbody');
  const head = h('tr');
  const more = h('p.small.muted');
  const fields = plainTable('fields', fieldColumns);
  const encounters = plainTable('encounters', encounterColumns);
  const coverages = plainTable('coverages', coverageColumns);
  const element = h('section.map-table', { hidden: true, 'aria-label': t('map.table') },
    h('header', null, h('h2', null, t('map.table')), h('button.button.quiet.square.small', { type: 'button', 'aria-label': t('map.closeTable'), on: { click: onClose } }, icon('close', 18))),
    h('div.map-tables', { tabindex: '0', role: 'group', 'aria-label': t('map.table') },
      encounters.element,
      h('div', null, titleOf('devices', deviceColumns, devices), h('div.table-frame', null, h('table.table', { 'aria-label': t('map.tables.devices') }, h('thead', null, head), body)), more),
      fields.element, coverages.element));

  function drawHead() {
    replace(head, COLUMNS.map((name) => h('th', { scope: 'col', 'aria-sort': name === sorted ? (down ? 'descending' : 'ascending') : null, class: NUMBERS.has(name) ? 'numbers' : '' },
      h('button.sort', { type: 'button', on: { click: () => { down = name === sorted && !down; sorted = name; drawHead(); draw(); } } }, t(`map.columns.${name}`)))));
  }

  function devices() {
    return [...store.entities.values()].filter((each) => store.inScope(each) && store.matches(each))
      .sort((a, b) => compare(valueOf(a, sorted), valueOf(b, sorted)) * (down ? -1 : 1) || compare(a.id, b.id));
  }

  function draw() {
    const now = store.now();
    const rows = devices();
    const focused = body.contains(document.activeElement) ? document.activeElement.dataset.id : null;
    replace(body, rows.slice(0, MAX_ROWS).map((each) => row(each, now)));
    more.textContent = rows.length > MAX_ROWS ? t('map.moreRows', { count: rows.length - MAX_ROWS }) : '';
    focused && body.querySelector(`[data-id="${CSS.escape(focused)}"]`)?.focus();
    encounters.draw([...store.encounters.values()].sort((a, b) => b.time - a.time));
    fields.draw(store.fieldsInScope().sort((a, b) => compare(a.name, b.name)).flatMap((field) => averagesOf(field).map((average) => ({ field, average }))));
    coverages.draw(store.coveragesInScope().filter(({ figures }) => figures).reverse());
  }

  drawHead();
  return {
    element,
    /** Redraws at most once a second. */
    changed() {
      if (!element.hidden && waiting === null) {
        waiting = setTimeout(() => { waiting = null; draw(); }, REDRAW_MILLIS);
      }
    },
    toggle() {
      element.hidden = !element.hidden;
      element.hidden || draw();
      return !element.hidden;
    },
    close() {
      clearTimeout(waiting);
    },
  };
}

/** A table without sorting, which is hidden while it has no rows; its button to save it stays where it is. @param {import('../core/table.js').Column[]} columns */
function plainTable(name, columns) {
  const title = t(`map.tables.${name}`);
  const kind = ({ isNumber }) => (isNumber ? 'numbers' : '');
  const frame = h('div.table-frame');
  let rows = [];
  const element = h('div', { hidden: true }, titleOf(name, columns, () => rows), frame);
  return {
    element,
    draw(now) {
      rows = now;
      element.hidden = rows.length === 0;
      replace(frame, h('table.table', { 'aria-label': title },
        h('thead', null, h('tr', null, columns.map((each) => h('th', { scope: 'col', class: kind(each) }, t(each.name))))),
        h('tbody', null, rows.map((row) => h('tr', null, columns.map((each, index) => (index ? h('td', { class: kind(each) }, each.words(row)) : h('th', { scope: 'row' }, each.words(row)))))))));
    },
  };
}

function titleOf(name, columns, rows) {
  const title = t(`map.tables.${name}`);
  return h('div.row', null, h('h3.spacer', null, title), csvButton(title, `map-${name}`, columns, rows));
}

/** How long ago the record of a row was; its time in the CSV. */
function ageColumn(timeOf) {
  return { name: 'map.columns.age', value: (row) => dateOf(timeOf(row)), words: (row) => (timeOf(row) === undefined ? '–' : age(store.now() - timeOf(row))), isNumber: true };
}

const encounterColumns = [
  textColumn('map.columns.pair', ({ a, b }) => `${nameOf(a)} – ${nameOf(b)}`),
  textColumn('map.columns.phase', ({ phase }) => t(`map.phases.${phase}`)),
  numberColumn('map.columns.distance', 'meter', (each) => each.distance, distance),
  numberColumn('map.columns.closest', 'meter', ({ minDistance }) => minDistance, distance),
  ageColumn(({ time }) => time),
];

/** Of a field with one of its averages, or without one. */
const fieldColumns = [
  textColumn('map.columns.field', ({ field, average }) => withDifference(field.name, average?.difference)),
  { name: 'map.columns.average', unit: 'celsius', value: ({ average }) => average?.value, words: ({ field, average }) => (field.exclusion ? t('map.noAlarms') : average ? temperature(average.value) : '–'), isNumber: true },
  { name: 'map.columns.devices', value: ({ average }) => average?.count, words: ({ average }) => (average ? `${average.count}${average.verified ? '' : ` · ${t('map.unverified')}`}` : '–'), isNumber: true },
  { name: 'map.columns.suspects', value: suspectsOf, words: (row) => suspectsOf(row) || '–' },
  ageColumn(({ average }) => average?.time),
];

const coverageColumns = [
  textColumn('map.columns.field', ({ field, fieldName }) => store.fields.get(field)?.name ?? fieldName),
  textColumn('map.columns.mission', ({ mission }) => mission || '–'),
  numberColumn('map.columns.hectares', 'hectare', ({ figures }) => figures.hectares, area),
  { name: 'map.columns.share', unit: 'percent', value: ({ figures }) => Math.round(10_000 * figures.share) / 100, words: ({ figures }) => percent(figures.share), isNumber: true },
  numberColumn('map.columns.overlap', 'hectare', ({ figures }) => figures.overlap, area),
  numberColumn('map.columns.gaps', 'hectare', ({ figures }) => figures.gaps, area),
  { name: 'map.columns.left', unit: 'second', value: ({ figures }) => (figures.left ?? NaN) / 1000, words: ({ figures }) => duration(figures.left ?? NaN), isNumber: true },
  ageColumn(({ time }) => time),
];

/** Of entities, for their CSV. */
const deviceColumns = [
  { name: 'map.columns.name', value: ({ name }) => name },
  { name: 'report.id', value: ({ id }) => id },
  { name: 'map.columns.kind', value: ({ kind }) => t(`kinds.${kind}`) },
  { name: 'map.columns.state', value: ({ state }) => t(`states.${state}`) },
  { name: 'map.columns.latitude', value: ({ position }) => position?.[1] },
  { name: 'map.columns.longitude', value: ({ position }) => position?.[0] },
  { name: 'map.columns.speed', unit: 'meterPerSecond', value: ({ speed }) => speed },
  ageColumn(({ time }) => time),
];

/** The averages of a field; without any, one that is null. */
function averagesOf({ id }) {
  const averages = store.averagesOf(id);
  return averages.length ? averages : [null];
}

function suspectsOf({ average }) {
  return average?.suspects.map(nameOf).join(', ') ?? '';
}

function nameOf(id) {
  return store.entities.get(id)?.name ?? shortId(id);
}

function row(entity, now) {
  return h('tr', { class: entity.id === store.selection ? 'selected' : '' },
    h('th', { scope: 'row' }, h('button.sort', { type: 'button', data: { id: entity.id }, on: { click: () => store.select(entity.id, { reveal: true }), focus: () => store.setHovered(entity.id) } }, entity.name)),
    h('td', null, t(`kinds.${entity.kind}`)),
    h('td', null, t(`states.${entity.state}`)),
    h('td.numbers', null, place(entity)),
    h('td.numbers', null, entity.speed === null ? '–' : t('map.speed', { speed: number(entity.speed) })),
    h('td.numbers', null, age(now - entity.time)));
}

function place(entity) {
  if (entity.position && !isOnMap(...entity.position)) {
    return t('map.faults.out-of-range');
  }
  if (entity.position) {
    return `${entity.position[1].toFixed(5)}, ${entity.position[0].toFixed(5)}`;
  }
  return entity.positionFault ? t(`map.faults.${entity.positionFault}`) : '–';
}

function valueOf(entity, column) {
  return { name: entity.name.toLowerCase(), kind: entity.kind, state: entity.state, position: entity.position?.[1] ?? -99, speed: entity.speed ?? -1, age: -entity.time }[column];
}

function compare(a, b) {
  return typeof a === 'number' ? a - b : String(a).localeCompare(String(b), undefined, { numeric: true });
}
