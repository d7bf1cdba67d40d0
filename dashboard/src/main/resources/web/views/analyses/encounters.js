/** Shows encounters as a sortable table; each row links to its moment. */
import { h, replace, setText } from '../../core/dom.js';
import { dateTime, distance, duration, moment } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { picturesAround } from '../../core/router.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';

/** Rows that are shown at first: each is a stop of the keyboard on the way to what follows. */
const FIRST_ROWS = 25;
const MORE_ROWS = 100;
const COLUMNS = {
  when: (each) => each.start, pair: (each) => each.pair, closest: (each) => each.closest, duration: (each) => each.end - each.start, phase: (each) => each.phase,
};
const CLASSES = { when: 'numbers-left when', pair: 'pair', closest: 'numbers', duration: 'numbers', phase: 'phase' };

export class EncounterTable {
  /** @param {function(Object)} showMoment shows the moment of an encounter */
  constructor(showMoment) {
    this.showMoment = showMoment;
    this.column = 'when';
    this.down = true;
    this.rows = new Map();
    // explicit roles, because on a narrow screen rows are not laid out as table rows
    this.body = h('tbody', { role: 'rowgroup' });
    this.heads = Object.keys(COLUMNS).map((name) => h('th', { class: name === 'closest' || name === 'duration' ? 'numbers' : '', role: 'columnheader', scope: 'col' },
      h('button.sort-by', { type: 'button', title: t('analyses.sort', { column: t(`analyses.${name}`) }), on: { click: () => this.sort(name) } }, t(`analyses.${name}`), icon('chevron-down', 14))));
    this.limit = FIRST_ROWS;
    this.more = h('button.button.quiet', { type: 'button', on: { click: () => this.showMore() } });
    this.element = h('div.stack', null, h('div.table-frame.encounter-frame', { tabindex: '0', role: 'group', 'aria-label': t('analyses.encounters') },
      h('table.table', { role: 'table' }, h('thead', { role: 'rowgroup' }, h('tr', { role: 'row' }, this.heads, h('th', { role: 'columnheader', scope: 'col' }, h('span.visually-hidden', null, t('analyses.toMoment'))))), this.body)), this.more);
  }

  sort(column) {
    this.down = this.column === column ? !this.down : column === 'when' || column === 'duration';
    this.column = column;
    this.show(this.encounters);
  }

  /** Shows more rows; the focus goes to the first of them. */
  showMore() {
    const first = this.limit;
    this.limit += MORE_ROWS;
    this.show(this.encounters);
    this.body.children[first]?.querySelector('button:not([hidden], :disabled)')?.focus();
  }

  show(encounters) {
    this.encounters = encounters;
    const of = COLUMNS[this.column];
    const sorted = [...encounters].sort((one, other) => {
      const [a, b] = [of(one), of(other)];
      const order = typeof a === 'string' ? a.localeCompare(b) : a - b;
      return (this.down ? -order : order) || other.start - one.start;
    });
    this.heads.forEach((head, index) => {
      const name = Object.keys(COLUMNS)[index];
      name === this.column ? head.setAttribute('aria-sort', this.down ? 'descending' : 'ascending') : head.removeAttribute('aria-sort');
    });
    const shown = sorted.slice(0, this.limit);
    this.more.hidden = sorted.length <= this.limit;
    setText(this.more, t('analyses.more', { shown: this.limit, count: sorted.length }));
    const ids = new Set(shown.map((each) => each.id));
    for (const [id, row] of this.rows) {
      if (!ids.has(id)) {
        row.element.remove();
        this.rows.delete(id);
      }
    }
    shown.forEach((encounter, index) => {
      const row = this.rows.get(encounter.id) ?? this.row(encounter.id);
      fill(row, encounter);
      if (this.body.children[index] !== row.element) {
        this.body.insertBefore(row.element, this.body.children[index] ?? null);
      }
    });
  }

  row(id) {
    const cells = Object.fromEntries(Object.keys(COLUMNS).map((name) => [name, h('td', { role: 'cell', class: CLASSES[name] ?? '', data: { name: t(`analyses.${name}`) } })]));
    const act = h('button.button.small', { type: 'button', on: { click: () => this.showMoment(row.encounter) } }, icon('map', 16), h('span.words', null, t('analyses.toMoment')));
    const around = h('a.button.small.quiet.square', { title: t('history.around') }, icon('camera', 16));
    const row = { cells, act, around, element: h('tr', { role: 'row' }, Object.values(cells), h('td.right', { role: 'cell' }, around, act)) };
    this.rows.set(id, row);
    return row;
  }
}

function fill(row, encounter) {
  const { cells, act } = row;
  row.encounter = encounter;
  row.element.classList.toggle('selected', [encounter.a, encounter.b].includes(store.selection));
  const going = encounter.phase === 'started' || encounter.phase === 'ongoing';
  setText(cells.when, moment(encounter.start));
  setText(cells.pair, encounter.pair);
  setText(cells.closest, distance(encounter.closest));
  setText(cells.duration, duration(encounter.end - encounter.start));
  const words = t(`analyses.phases.${encounter.phase}`);
  if (cells.phase.textContent !== words) {
    replace(cells.phase, h(`span.pill${going ? '.bad' : ''}`, null, words));
  }
  const recorded = store.isReplay || encounter.missions.some((mission) => store.recordings.has(mission));
  act.hidden = !store.may('operate');
  act.disabled = !recorded;
  act.title = !recorded ? t('analyses.noRecording') : '';
  row.around.href = picturesAround(encounter.a, encounter.start, encounter.end);
  row.around.setAttribute('aria-label', t('history.aroundOf', { pair: encounter.pair, time: dateTime(encounter.start) }));
  act.setAttribute('aria-label', t('analyses.toMomentOf', { pair: encounter.pair, time: dateTime(encounter.start) }));
}
