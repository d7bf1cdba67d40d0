/** Shows the report of a mission on one page, to be printed or saved as PDF. */
import { csvButton } from '../core/csv.js';
import { h, replace } from '../core/dom.js';
import { area, clock, dateTime, day, distance, duration, percent, zone } from '../core/format.js';
import { icon } from '../core/icons.js';
import { linkTo, onRoute, route } from '../core/router.js';
import { tableOf } from '../core/table.js';
import { t } from '../texts.js';
import { statePill } from './missions/list.js';
import { COLUMNS } from './report/columns.js';
import { readReport } from './report/data.js';
import { mapsOf } from './report/map.js';

/** Rows of a table on paper; its CSV has all. */
const MAX_ROWS = 200;
const DAY = 24 * 3_600_000;

class FurrowReport extends HTMLElement {
  connectedCallback() {
    this.content = h('div.stack.report-content');
    this.name = null;
    this.close = onRoute(() => this.follow());
    this.follow();
  }

  disconnectedCallback() {
    this.close();
    this.reading = null;
  }

  follow() {
    const { mission = '' } = route.query;
    if (route.view === 'report' && mission !== this.name) {
      this.name = mission;
      this.load();
    }
  }

  async load() {
    const reading = (this.reading = Symbol('reading'));
    const { name } = this;
    document.title = `${t('report.title', { mission: name })} · ${t('app.title')}`; // the name of the PDF
    this.show(null, h('div.stack', { 'aria-busy': 'true' }, h('p.visually-hidden', { role: 'status' }, t('report.reading')), [0, 1, 2].map(() => h('div.skeleton.list-skeleton', null, '…'))));
    try {
      const report = name ? await readReport(name) : null;
      if (this.reading === reading) {
        this.show(report, report ? this.parts(report) : h('div.empty', null, h('h2', null, t('report.none')), h('p', null, t('report.noneHint')), h('a.button', { href: linkTo('missions', { mission: name || null }) }, t('report.toMission'))));
      }
    } catch (error) {
      this.reading === reading && this.show(null, h('p.error-note', { role: 'alert' }, icon('warning', 18), h('span', null, t('analyses.failed', { reason: error.message })), h('span.spacer'),
        h('button.button.small', { type: 'button', on: { click: () => this.load() } }, t('analyses.retry'))));
    }
  }

  show(report, content) {
    const { name } = this;
    const { mission } = report ?? {};
    replace(this, h('div.view.report', null,
      h('header', null,
        h('div', null, h('h1', null, t('report.title', { mission: name })), h('p.muted', null, [mission?.domain, mission?.template].filter(Boolean).join(' · '))),
        mission && statePill(mission.status?.state), h('span.spacer'),
        h('div.row.wrap.report-acts', null, h('a.button', { href: linkTo('missions', { mission: name }) }, icon('flag', 16), t('report.toMission')),
          report && h('button.button', { type: 'button', on: { click: () => this.load() } }, icon('history', 16), t('report.again')),
          report && h('button.button.primary', { type: 'button', on: { click: () => print() } }, t('report.print')))),
      content));
  }

  parts(report) {
    const { runs, coverages, encounters, averages, alarms, markers, devices } = report;
    return [
      h('dl.report-facts', null, facts(report).map(([name, value, more]) => h('div', null, h('dt', null, t(`report.${name}`)), h('dd', null, h('strong.numbers', null, value), more && h('span.small.muted', null, more))))),
      report.fields.length > 0 && h('section.stack', { 'aria-label': t('report.map') }, h('h2', null, t('report.map')), mapsOf(report.fields, coverages.rows, report.layers)),
      Object.entries({ ...(runs.error || runs.rows.length > 1 ? { runs } : {}), coverages, encounters, averages, alarms, markers, devices }).map(([name, part]) => this.section(name, part, report.from)),
      h('p.small.muted', null, t('report.made', { time: dateTime(Date.now()), zone: zone(Date.now()) })),
    ];
  }

  section(name, { rows, since, error }, from) {
    const title = t(`report.${name}`);
    return h(`section.stack.report-${name}`, { 'aria-label': title },
      h('div.row', null, h('h2', null, title), !error && h('span.numbers.muted', null, rows.length), h('span.spacer'), rows.length > 0 && csvButton(title, `${this.name}-${name}`, COLUMNS[name], () => rows)),
      error ? h('p.error-note', { role: 'alert' }, icon('warning', 18), t('analyses.failed', { reason: error.message }))
        : rows.length ? tableOf(title, COLUMNS[name], rows.slice(0, MAX_ROWS)) : h('p.muted', null, t(`report.no.${name}`)),
      rows.length > MAX_ROWS && h('p.small.muted', null, t('report.more', { shown: MAX_ROWS, count: rows.length })),
      since > from && h('p.small.muted', null, t('analyses.since', { time: dateTime(since) })),
      name === 'alarms' && h('p.small.muted', null, t('report.alarmsRetained')));
  }
}

/** @returns {Array<[string, string|number, string|undefined]>} the name of each figure, its value, and more of it */
function facts({ from, to, isRunning, isCut, runs, coverages, encounters, alarms, markers, devices }) {
  const sum = (of) => coverages.rows.reduce((total, { figures }) => total + of(figures), 0);
  const [worked, whole] = [sum(({ hectares }) => hectares), sum(({ fieldHectares }) => fieldHectares)];
  const closest = Math.min(...encounters.rows.map((each) => each.closest));
  const count = ({ rows, error }) => (error ? '–' : rows.length);
  return [
    ['time', `${dateTime(from)} – ${day(from) === day(to) && to - from < DAY ? clock(to) : dateTime(to)}`, [runs.rows.length > 1 && t('report.countRuns', { count: runs.rows.length }), isRunning ? t('report.running') : zone(to), isCut && t('replays.wrongClock')].filter(Boolean).join(' · ')],
    ['length', hours(runs.rows.reduce((total, run) => total + run.to - run.from, 0) || to - from)],
    ['hectares', coverages.rows.length ? area(worked) : '–', coverages.rows.length ? t('report.ofFields', { share: percent(worked / whole), hectares: area(whole) }) : undefined],
    ['encounters', count(encounters), Number.isFinite(closest) ? t('map.closest', { distance: distance(closest) }) : undefined],
    ['alarms', count(alarms)], ['markers', count(markers)], ['devices', count(devices)],
  ];
}

/** "2 h 5 min". */
function hours(ms) {
  const minutes = Math.round(ms / 60_000);
  return minutes < 60 ? duration(ms) : `${Math.floor(minutes / 60)} ${t('units.hour')} ${minutes % 60} ${t('units.minute')}`;
}

customElements.define('furrow-report', FurrowReport);
