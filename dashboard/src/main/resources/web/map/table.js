/** Shows the content of the map as tables. */
import { age, area, distance, duration, number, percent, shortId, temperature } from '../core/format.js';
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { withDifference } from '../core/identities.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { isOnMap } from './projection.js';

const COLUMNS = ['name', 'kind', 'state', 'position', 'speed', 'age'];
const NUMBERS = new Set(['position', 'speed', 'age', 'average', 'devices', 'distance', 'closest', 'hectares', 'share', 'overlap', 'gaps', 'left']);
const MAX_ROWS = 500;
const REDRAW_MILLIS = 1_000;

export function mapTables(onClose) {
  let sorted = 'name';
  let down = false;
  let waiting = null;
  const body = h('tbody');
  const head = h('tr');
  const more = h('p.small.muted');
  const fields = h('div');
  const encounters = h('div');
  const coverages = h('div');
  const element = h('section.map-table', { hidden: true, 'aria-label': t('map.table') },
    h('header', null, h('h2', null, t('map.table')), h('button.button.quiet.square.small', { type: 'button', 'aria-label': t('map.closeTable'), on: { click: onClose } }, icon('close', 18))),
    h('div.map-tables', { tabindex: '0', role: 'group', 'aria-label': t('map.table') },
      encounters,
      h('div', null, h('h3', null, t('map.tables.devices')), h('div.table-frame', null, h('table.table', { 'aria-label': t('map.tables.devices') }, h('thead', null, head), body)), more),
      fields, coverages));

  function drawHead() {
    replace(head, COLUMNS.map((name) => h('th', { scope: 'col', 'aria-sort': name === sorted ? (down ? 'descending' : 'ascending') : null, class: NUMBERS.has(name) ? 'numbers' : '' },
      h('button.sort', { type: 'button', on: { click: () => { down = name === sorted && !down; sorted = name; drawHead(); draw(); } } }, t(`map.columns.${name}`)))));
  }

  function draw() {
    const now = store.now();
    const rows = [...store.entities.values()].filter((each) => store.inScope(each) && store.matches(each));
    rows.sort((a, b) => compare(valueOf(a, sorted), valueOf(b, sorted)) * (down ? -1 : 1) || compare(a.id, b.id));
    const focused = body.contains(document.activeElement) ? document.activeElement.dataset.id : null;
    replace(body, rows.slice(0, MAX_ROWS).map((each) => row(each, now)));
    more.textContent = rows.length > MAX_ROWS ? t('map.moreRows', { count: rows.length - MAX_ROWS }) : '';
    focused && body.querySelector(`[data-id="${CSS.escape(focused)}"]`)?.focus();
    drawTable(encounters, 'encounters', ['pair', 'phase', 'distance', 'closest', 'age'], [...store.encounters.values()].sort((a, b) => b.time - a.time).map((each) => encounterRow(each, now)));
    drawTable(fields, 'fields', ['field', 'average', 'devices', 'suspects', 'age'], store.fieldsInScope().sort((a, b) => compare(a.name, b.name)).flatMap((each) => fieldRows(each, now)));
    drawTable(coverages, 'coverages', ['field', 'mission', 'hectares', 'share', 'overlap', 'gaps', 'left', 'age'], store.coveragesInScope().filter(({ figures }) => figures).reverse().map((each) => coverageRow(each, now)));
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

/** Draws a table, or nothing if it has no rows. */
function drawTable(place, name, columns, rows) {
  replace(place, rows.length > 0 && [h('h3', null, t(`map.tables.${name}`)), h('div.table-frame', null, h('table.table', { 'aria-label': t(`map.tables.${name}`) },
    h('thead', null, h('tr', null, columns.map((each) => h('th', { scope: 'col', class: NUMBERS.has(each) ? 'numbers' : '' }, t(`map.columns.${each}`))))),
    h('tbody', null, rows)))]);
}

function encounterRow(encounter, now) {
  return h('tr', null,
    h('th', { scope: 'row' }, `${nameOf(encounter.a)} – ${nameOf(encounter.b)}`),
    h('td', null, t(`map.phases.${encounter.phase}`)),
    h('td.numbers', null, distance(encounter.distance)),
    h('td.numbers', null, distance(encounter.minDistance)),
    h('td.numbers', null, age(now - encounter.time)));
}

/** One row per average, or one without. */
function fieldRows(field, now) {
  const averages = store.averagesOf(field.id);
  return averages.length ? averages.map((each) => fieldRow(field, each, now)) : [fieldRow(field, null, now)];
}

function fieldRow(field, average, now) {
  return h('tr', null,
    h('th', { scope: 'row' }, withDifference(field.name, average?.difference)),
    h('td.numbers', null, field.exclusion ? t('map.noAlarms') : average ? temperature(average.value) : '–'),
    h('td.numbers', null, average ? `${average.count}${average.verified ? '' : ` · ${t('map.unverified')}`}` : '–'),
    h('td', null, average?.suspects.length ? average.suspects.map(nameOf).join(', ') : '–'),
    h('td.numbers', null, average ? age(now - average.time) : '–'));
}

function coverageRow({ field, fieldName, mission, figures, time }, now) {
  return h('tr', null,
    h('th', { scope: 'row' }, store.fields.get(field)?.name ?? fieldName),
    h('td', null, mission || '–'),
    ...[area(figures.hectares), percent(figures.share), area(figures.overlap), area(figures.gaps), duration(figures.left ?? NaN), age(now - time)].map((words) => h('td.numbers', null, words)));
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
