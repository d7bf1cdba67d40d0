/** Shows the results of analytics: averages of fields, encounters and presence, live or of a replay. */
import { h, replace, setText } from '../core/dom.js';
import { csvButton } from '../core/csv.js';
import { dateTime } from '../core/format.js';
import { icon } from '../core/icons.js';
import { navigate, parameter } from '../core/router.js';
import { scopeName } from '../core/scope.js';
import { store } from '../core/store.js';
import { tableOf } from '../core/table.js';
import { t } from '../texts.js';
import { startReplay, steer } from '../timeline/control.js';
import { AveragesChart } from './analyses/chart.js';
import { COLUMNS } from './analyses/columns.js';
import { Findings } from './analyses/data.js';
import { EncounterTable } from './analyses/encounters.js';
import { PresenceBars } from './analyses/presence.js';

const MINUTE = 60_000;
const PERIODS = [15 * MINUTE, 60 * MINUTE, 6 * 60 * MINUTE, 24 * 60 * MINUTE];
const TICK = 5_000;
/** Time before an encounter at which its replay begins, ms. */
const LEAD_MILLIS = 5_000;
const MAX_ROWS = 500;

class Analyses extends HTMLElement {
  connectedCallback() {
    this.period = PERIODS[1];
    this.tables = new Set();
    this.chart = new AveragesChart();
    this.encounters = new EncounterTable((each) => this.showMoment(each));
    this.presence = new PresenceBars((stay) => this.showMoment({ start: stay.from + LEAD_MILLIS, missions: [stay.mission].filter(Boolean), a: stay.device }));
    this.build();
    this.kept = {
      period: parameter('period', { view: 'analyses', get: () => (this.period === PERIODS[1] ? null : String(this.period / MINUTE)), set: (minutes) => this.choose(Number(minutes) * MINUTE) }),
      tables: parameter('tables', { view: 'analyses', get: () => [...this.tables].join(), set: (names) => this.chooseTables(names.split(',')) }),
    };
    this.subscriptions = [
      store.on('mode', () => this.modeChanged()), store.on('fields', () => this.schedule()), store.on('recordings', () => this.schedule()), store.on('me', () => this.schedule()),
      store.on('scope', () => this.schedule()), ...Object.values(this.kept).map(({ close }) => close),
    ];
    this.timer = setInterval(() => document.hidden || this.show(), TICK);
    this.load();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    clearInterval(this.timer);
    cancelAnimationFrame(this.frame);
    this.findings?.close();
    this.chart.close();
    this.presence.close();
  }

  build() {
    this.subtitle = h('p.muted');
    this.periods = h('div.segments', { role: 'group', 'aria-label': t('analyses.period') }, PERIODS.map((period) => h('button.button.small', {
      type: 'button', data: { period }, on: { click: () => this.choose(period) },
    }, t(period < 60 * MINUTE ? 'analyses.quarter' : period === 60 * MINUTE ? 'history.hour' : 'analyses.hours', { hours: period / 60 / MINUTE }))));
    this.note = h('p.small', { role: 'status' });
    this.failed = h('div', { hidden: true });
    this.parts = Object.fromEntries(['averages', 'encounters', 'presence'].map((name) => [name, this.part(name)]));
    replace(this, h('div.view', null,
      h('header', null, h('div', null, h('h1', null, t('analyses.title')), this.subtitle), h('span.spacer'), this.periods),
      this.failed, this.note, Object.values(this.parts).map((each) => each.element)));
  }

  part(name) {
    const count = h('span.numbers');
    const content = h('div');
    const since = h('p.small.muted', { hidden: true });
    const csv = csvButton(t(`analyses.${name}`), name, COLUMNS[name], () => this.parts[name].found);
    const asTable = name === 'encounters' ? null : h('button.button.small.quiet', { type: 'button', 'aria-pressed': 'false', on: { click: () => this.toggleTable(name) } }, icon('table', 16), t('analyses.table'));
    const element = h(`section.panel.stack.analysis.${name}`, { 'aria-label': t(`analyses.${name}`) }, h('div.row', null, h('h2', null, t(`analyses.${name}`)), count, h('span.spacer'), csv, asTable), content, since);
    return { name, element, count, content, since, csv, asTable, shown: null };
  }

  toggleTable(name) {
    this.chooseTables(this.tables.has(name) ? [...this.tables].filter((each) => each !== name) : [...this.tables, name]);
    this.kept.tables.write();
    this.show();
  }

  chooseTables(names) {
    this.tables = new Set(names.filter((each) => this.parts[each]?.asTable));
    Object.values(this.parts).forEach(({ name, asTable }) => asTable?.setAttribute('aria-pressed', String(this.tables.has(name))));
    this.findings && this.schedule();
  }

  choose(period) {
    if (PERIODS.includes(period)) {
      this.period = period;
      this.kept?.period.write();
      this.findings && this.load();
    }
  }

  modeChanged() {
    if (this.modeKey !== this.keyOfMode()) {
      this.load();
    }
  }

  keyOfMode() {
    return store.isReplay ? `${store.mode.replay}` : 'live';
  }

  /** Loads the results of a replay with analytics, else live results. */
  load() {
    this.modeKey = this.keyOfMode();
    this.findings?.close();
    const { mode } = store;
    const replayed = store.isReplay && (store.replays.get(mode.replay)?.analytics?.length ?? 0) > 0;
    const topics = replayed
      ? { averages: mode.results.temperature, encounters: mode.results.collision, stays: mode.results.presence }
      : { averages: [{ topic: 'data.temperature' }], encounters: [{ topic: 'data.collision' }], stays: [{ topic: 'data.presence' }] };
    this.replayed = replayed;
    this.findings = new Findings(topics, this.range, { replay: replayed, group: replayed && mode.missions.length > 1 ? mode.missions : [], changed: () => this.schedule() });
    this.periods.hidden = store.isReplay;
    for (const button of this.periods.children) {
      button.setAttribute('aria-pressed', String(Number(button.dataset.period) === this.period));
    }
    setText(this.note, store.isReplay && !replayed ? t('analyses.noAnalytics') : '');
    this.note.hidden = this.note.textContent === '';
    this.show();
  }

  get range() {
    if (store.isReplay) {
      const { from, to } = store.mode;
      const first = from ?? Date.now() - this.period;
      return [first, Math.max(first + MINUTE, to ?? Date.now())];
    }
    const now = Date.now();
    return [now - this.period, now];
  }

  /** Begins with the oldest result, so that a suite that has just started does not show an empty hour. */
  fitted([from, to]) {
    const first = this.findings.first;
    return store.isReplay || first === null ? [from, to] : [Math.max(from, Math.min(first, to - MINUTE)), to];
  }

  schedule() {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.show());
  }

  show() {
    const { findings } = this;
    const range = this.fitted(this.range);
    const [from, to] = range;
    this.failed.hidden = !findings.error;
    if (findings.error) {
      replace(this.failed, h('p.error-note', { role: 'alert' }, icon('warning', 18), h('span', null, t('analyses.failed', { reason: findings.error.message })), h('span.spacer'),
        h('button.button.small', { type: 'button', on: { click: () => this.load() } }, t('analyses.retry'))));
    }
    const { domain } = store.scope;
    const fields = new Set(store.fieldsInScope().map(({ id }) => id));
    const averages = findings.averages(from, to).filter(({ field }) => domain === null || fields.has(field));
    const encounters = findings.encountersIn(from, to).filter((each) => store.isAboutScope([each.a, each.b].map((id) => store.entities.get(id))));
    const stays = findings.stays(from, to).filter((each) => store.isAboutScope([store.entities.get(each.device)]));
    const words = !this.replayed ? t('analyses.live') : t('analyses.replay', { mission: store.mode.missions.join(' + ') });
    setText(this.subtitle, domain === null ? words : `${words} ${t('app.only', { scope: scopeName() })}`);
    this.fill(this.parts.averages, averages, findings.since.averages, () => this.showAverages(averages, range));
    this.fill(this.parts.encounters, encounters, findings.since.encounters, () => { this.put(this.parts.encounters, 'list', this.encounters.element); this.encounters.show(encounters); });
    this.fill(this.parts.presence, stays, findings.since.stays, () => this.showPresence(stays, range));
  }

  /** Fills a part: loading, empty, or with its results. */
  fill(part, found, since, draw) {
    const { loading, error } = this.findings;
    setText(part.count, found.length ? String(found.length) : '');
    part.found = found;
    part.csv.hidden = !found.length;
    part.asTable && (part.asTable.hidden = !found.length);
    if (!found.length) {
      const state = loading ? 'loading' : error ? 'error' : 'empty';
      const words = part.name.charAt(0).toUpperCase() + part.name.slice(1);
      this.put(part, state, state === 'loading' ? h('div.skeleton.analysis-skeleton', { 'aria-busy': 'true' })
        : state === 'error' ? h('p.muted', null, '–') : h('div.empty', null, h('h3', null, t(`analyses.no${words}`)), h('p', null, t(`analyses.no${words}Hint`))));
    } else {
      draw();
    }
    const cut = !this.replayed && since > this.range[0] + MINUTE && found.length > 0;
    part.since.hidden = !cut;
    cut && setText(part.since, t('analyses.since', { time: dateTime(since) }));
  }

  put(part, kind, element) {
    if (part.shown !== kind) {
      part.shown = kind;
      replace(part.content, element);
    }
  }

  showAverages(averages, range) {
    const part = this.parts.averages;
    if (!this.tables.has('averages')) {
      this.put(part, 'chart', this.chart.element);
      this.chart.show(averages, range);
      return;
    }
    this.putTable(part, averages);
  }

  showPresence(stays, range) {
    const part = this.parts.presence;
    if (!this.tables.has('presence')) {
      this.put(part, 'bars', this.presence.element);
      this.presence.show(stays, range);
      return;
    }
    this.putTable(part, stays);
  }

  /** Shows a table, the newest rows first. */
  putTable(part, found) {
    const table = tableOf(t(`analyses.${part.name}`), COLUMNS[part.name], found.slice(-MAX_ROWS).reverse());
    table.classList.add('analysis-table');
    this.put(part, `table ${found.length} ${JSON.stringify(found.at(-1))}`, table);
  }

  /** Shows a moment on the map: by a seek in a replay, else by a replay of the recording. */
  async showMoment({ start, missions, a }) {
    const to = Math.round(start - LEAD_MILLIS);
    if (!store.may('operate')) {
      return;
    }
    try {
      if (store.isReplay) {
        await steer(store.mode, 'seek', { to: Math.max(to, this.range[0]) });
      } else {
        await this.play(missions.filter((each) => store.recordings.has(each)), to);
      }
      store.select(a, { reveal: true });
      navigate('map');
    } catch (error) {
      this.announce(error.message === 'not-played' ? t('replays.notPlayed') : error.message);
    }
  }

  async play(missions, to) {
    const all = [...new Set(missions)];
    if (!all.length) {
      throw new Error(t('analyses.noRecording'));
    }
    const firsts = all.map((each) => store.recordings.get(each).first);
    // a replay started before the encounter may end before it
    const running = all.length === 1 && [...store.replays.values()].find((each) => !each.gone && !each.group && each.mission === all[0]
      && !['stopped', 'failed'].includes(each.status?.state) && each.status?.progress?.to >= to);
    const at = Math.max(to, Math.min(...firsts));
    if (running) {
      store.enterReplay(running);
      await steer(store.mode, 'seek', { to: at });
    } else {
      this.announce(t('timeline.starting'));
      await startReplay({ ...(all.length > 1 ? { missions: all } : { mission: all[0] }), analytics: store.config.analytics }, at);
    }
  }

  announce(words) {
    this.note.hidden = false;
    setText(this.note, words);
  }
}

customElements.define('furrow-analyses', Analyses);
