/** Lists recorded missions for replays, and the replays that run. */
import { absence } from '../core/absence.js';
import { csvButton, dateOf } from '../core/csv.js';
import { h, replace, setText } from '../core/dom.js';
import { dateTime, duration, number } from '../core/format.js';
import { amendAddress, linkTo, onRoute, route } from '../core/router.js';
import { icon } from '../core/icons.js';
import { others } from '../core/scope.js';
import { store } from '../core/store.js';
import { streams } from '../core/stream.js';
import { t } from '../texts.js';
import { Plan } from './replays/plan.js';
import { Preview } from './replays/preview.js';
import { COLUMNS as RUNNING, drawRunning, grouped } from './replays/running.js';

/** A mission whose newest event is younger is still being recorded, ms. */
const RECORDING_TIMEOUT = 90_000;
/** Below this width the plan is below the list. */
const NARROW = matchMedia('(max-width: 1200px)');
const ANNOUNCED_MILLIS = 6_000;
/** No mission is longer, ms: a report with a time far off is part of the recording. */
const YEAR = 366 * 86_400_000;

class Replays extends HTMLElement {
  connectedCallback() {
    this.chosen = new Set();
    this.rows = new Map();
    this.runningDrawn = new Map();
    this.entities = new Map();
    this.plan = new Plan();
    this.runningList = h('ul.running-list');
    this.runningCsv = csvButton(t('replays.running'), 'replays', RUNNING, () => grouped(store.replays.values()));
    this.runningTitle = h('h2.section-title.spacer', null, t('replays.running'), h('span.numbers'));
    this.noRunning = h('div');
    this.recordedTitle = h('h2.section-title.spacer', null, t('replays.recorded'), h('span.numbers'));
    this.csv = csvButton(t('replays.recorded'), 'recordings', this.columns(), () => this.recordings());
    this.body = h('tbody');
    this.table = h('div.table-frame', null, h('table.table.recordings', { 'aria-label': t('replays.recorded') },
      h('thead', null, h('tr', null, h('th', null, h('span.visually-hidden', null, t('replays.choice'))), h('th', null, t('replays.choice')), h('th', null, t('replays.when')),
        h('th.numbers', null, t('replays.length')), h('th.numbers', null, t('replays.devices')), h('th.numbers', null, t('replays.events')), h('th.preview-cell', null, t('replays.density')))),
      this.body));
    this.state = h('div');
    this.announcement = h('p.replay-said.small', { role: 'status' });
    replace(this, h('div.view', null,
      h('header', null, h('div', null, h('h1', null, t('replays.title')), h('p.muted', null, t('replays.lead'))), h('span.spacer'), this.announcement),
      h('section.stack', null, h('div.row', null, this.runningTitle, this.runningCsv), this.runningList, this.noRunning),
      h('div.replay-columns', null, h('section.stack', null, h('div.row', null, this.recordedTitle, this.csv), this.state, this.table), this.plan.element)));
    this.catalog = streams.subscribe('data.catalog', { mode: 'latest', prime: true, createdLater: true }, { records: (records) => this.applyCatalog(records) });
    this.onScheme = () => this.rows.forEach((row) => row.preview.draw());
    window.addEventListener('schemechange', this.onScheme);
    this.subscriptions = [
      store.on('replays', () => this.showRunning()), store.on('mode', () => this.showRunning()), store.on('recordings', () => this.showRecordings()),
      store.on('missions', () => this.showRecordings()), store.on('scope', () => this.showRecordings()), store.on('me', () => this.allow()), onRoute(() => this.openLink()),
    ];
    this.allow();
    this.showRunning();
    this.showRecordings();
    this.openLink();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.catalog.close();
    clearTimeout(this.announceTimer);
    window.removeEventListener('schemechange', this.onScheme);
    this.rows.forEach((row) => row.preview.close());
  }

  /** Hides choices from users who may not start replays. */
  allow() {
    this.classList.toggle('view-only', !store.may('operate'));
    this.choose();
  }

  /** Follows a link: `#/replays?mission=a,b&at=ISO`; without a mission it means those that were recorded then. */
  openLink() {
    const { mission, at } = route.query;
    if (route.view === 'replays' && (mission || at)) {
      this.linked = { missions: mission?.split(','), at: at ? Date.parse(at) : undefined };
      this.showRecordings();
    }
  }

  applyCatalog(records) {
    for (const { key, value } of records) {
      const mission = value?.mission ?? String(key).split('|')[2];
      const types = this.entities.get(mission) ?? new Map();
      value ? types.set(key, value.entities ?? 0) : types.delete(key);
      this.entities.set(mission, types);
    }
    this.rows.forEach((row) => this.fill(row));
  }

  showRunning() {
    const entries = grouped(store.replays.values());
    drawRunning(this.runningList, this.runningDrawn, entries, (words) => this.announce(words));
    setText(this.runningTitle.lastChild, entries.length || '');
    this.runningCsv.hidden = entries.length === 0;
    replace(this.noRunning, absence('replays', entries.length, () => h('div.empty', null, h('h3', null, t('replays.noRunning')), h('p.for-operators', null, t('replays.noRunningHint')))));
  }

  /** Those in scope, the newest first. */
  recordings() {
    return [...store.recordings.values()].filter(({ mission }) => store.hasInScope(mission, store.missions.get(mission)?.domain)).sort((one, other) => other.last - one.last || one.mission.localeCompare(other.mission));
  }

  columns() {
    return [
      { name: 'replays.choice', value: ({ mission }) => mission },
      { name: 'missions.domain', value: ({ mission }) => store.missions.get(mission)?.domain },
      { name: 'analyses.from', value: ({ first }) => dateOf(first) },
      { name: 'analyses.to', value: ({ last }) => dateOf(last) },
      { name: 'replays.length', unit: 'second', value: ({ first, last }) => (last - first) / 1000 },
      { name: 'replays.devices', value: ({ mission }) => this.entitiesOf(mission) || null },
      { name: 'replays.events', value: ({ mission }) => this.rows.get(mission)?.preview.events },
    ];
  }

  entitiesOf(mission) {
    return [...(this.entities.get(mission)?.values() ?? [])].reduce((sum, each) => sum + each, 0);
  }

  showRecordings() {
    const recordings = this.recordings();
    const shown = new Set(recordings.map((each) => each.mission));
    for (const [mission, row] of this.rows) {
      if (!shown.has(mission)) {
        row.preview.close();
        row.element.remove();
        this.rows.delete(mission);
        this.chosen.delete(mission);
      }
    }
    recordings.forEach((recording, index) => {
      const existing = this.rows.get(recording.mission);
      const row = existing ?? this.row(recording.mission);
      // existing rows do not move, so that the pointer stays on the same row
      existing || this.body.insertBefore(row.element, this.body.children[index] ?? null);
      this.fill(row);
      row.preview.update(recording.last);
    });
    setText(this.recordedTitle.lastChild, recordings.length || '');
    this.table.hidden = this.csv.hidden = recordings.length === 0;
    this.plan.element.hidden = recordings.length === 0;
    replace(this.state, others(store.recordings.size - recordings.length), absence('recordings', store.recordings.size, () => this.emptyState()));
    const linked = this.linked && (this.linked.missions ?? recordings.filter(({ first, last }) => first <= this.linked.at && this.linked.at <= last + RECORDING_TIMEOUT).map((each) => each.mission));
    if (linked?.length && linked.every((each) => store.recordings.has(each))) {
      this.chosen = new Set(linked);
      this.at = this.linked.at;
      this.linked = null;
    }
    this.choose();
  }

  emptyState() {
    return h('div.empty', null, h('h3', null, t('replays.none')), h('p', null, t('replays.noneHint')),
      h('a.button', { href: linkTo('missions') }, icon('flag', 18), t('replays.noneButton')));
  }

  row(mission) {
    const preview = new Preview(mission, () => this.rows.has(mission) && this.fill(this.rows.get(mission)));
    const check = h('input', { type: 'checkbox', 'aria-label': t('replays.choose', { mission }), on: { change: () => this.toggle(mission) } });
    const cells = { name: h('strong'), domain: h('span.small.muted'), when: h('td.numbers-left'), length: h('td.numbers'), devices: h('td.numbers'), events: h('td.numbers') };
    const element = h('tr', { on: { click: (event) => event.target.closest('input') || this.toggle(mission, true) } },
      h('td', null, check), h('td', null, h('div', null, cells.name), cells.domain), cells.when, cells.length, cells.devices, cells.events, h('td.preview-cell', null, preview.element));
    const row = { mission, element, check, cells, preview };
    this.rows.set(mission, row);
    preview.draw();
    return row;
  }

  fill({ mission, cells, preview, check, element }) {
    const { first, last } = store.recordings.get(mission);
    const entities = this.entitiesOf(mission);
    setText(cells.name, mission);
    setText(cells.domain, store.missions.get(mission)?.domain ?? '');
    const isRecording = Date.now() - last < RECORDING_TIMEOUT && Boolean(store.missions.get(mission)?.running);
    const words = dateTime(first);
    if (cells.when.dataset.words !== words + isRecording) {
      cells.when.dataset.words = words + isRecording;
      replace(cells.when, words, isRecording && h('div.small.live-word', null, t('replays.now')));
    }
    setText(cells.length, duration(last - first));
    const isWrong = last - first > YEAR;
    cells.length.classList.toggle('warn', isWrong);
    cells.length.title = isWrong ? t('replays.wrongClock') : '';
    setText(cells.devices, entities ? number(entities) : '–');
    setText(cells.events, preview.events === null ? '…' : number(preview.events));
    check.checked = this.chosen.has(mission);
    element.classList.toggle('selected', check.checked);
  }

  /** Chooses a mission: a click on its row chooses only this one, its checkbox adds it. @param {boolean} alone */
  toggle(mission, alone = false) {
    if (!store.may('operate')) {
      return;
    }
    if (alone) {
      this.chosen = new Set(this.chosen.size === 1 && this.chosen.has(mission) ? [] : [mission]);
    } else {
      this.chosen.has(mission) ? this.chosen.delete(mission) : this.chosen.add(mission);
    }
    this.at = undefined;
    amendAddress({ mission: [...this.chosen].join() || null, at: null });
    this.choose();
    alone && this.chosen.size > 0 && NARROW.matches && this.plan.element.scrollIntoView({ block: 'nearest' });
  }

  choose() {
    this.rows.forEach((row) => {
      row.check.checked = this.chosen.has(row.mission);
      row.element.classList.toggle('selected', row.check.checked);
    });
    this.plan.show([...this.chosen], this.at);
  }

  announce(words) {
    clearTimeout(this.announceTimer);
    setText(this.announcement, words);
    this.announceTimer = setTimeout(() => setText(this.announcement, ''), ANNOUNCED_MILLIS);
  }
}

customElements.define('furrow-replays', Replays);
