/** Shows the state of the platform: problems, parts, lag, dead letters and delays of reports. */
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { label, number } from '../core/format.js';
import { resource } from '../core/resource.js';
import { store } from '../core/store.js';
import { streams } from '../core/stream.js';
import { t, texts } from '../texts.js';
import { HopDelays } from './platform/hops.js';

const POLL_MILLIS = 3_000;
/** Lag above which a group is reported as a problem, records. */
const MAX_LAG = 1_000;
/** Groups of jobs that compute for one replay; they are many, and outlive it. */
const OF_REPLAY = /-of-.+\.[0-9a-f-]{8,}/;

class FurrowPlatform extends HTMLElement {
  connectedCallback() {
    this.delays = new HopDelays();
    this.streams = new Map();
    this.wrong = h('section.panel.stack', { 'aria-live': 'polite' });
    this.hops = h('section.panel.stack');
    this.parts = h('section.panel.stack');
    this.groups = h('section.panel.stack');
    this.letters = h('section.panel.stack');
    replace(this, h('div.view', null, h('header', null, h('h1', null, t('views.platform'))), this.wrong, this.hops, h('div.platform-columns', null, this.parts, h('div.stack', null, this.groups, this.letters))));
    this.platform = resource('/api/platform', { interval: POLL_MILLIS });
    this.subscriptions = [this.platform.on(() => this.draw()), store.on('domains', () => this.subscribe())];
    this.ticking = setInterval(() => document.hidden || this.drawHops(), 1_000);
    [this.wrong, this.parts, this.groups, this.letters].forEach((each) => replace(each, h('div.skeleton', null, '…')));
    this.subscribe();
    this.drawHops();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.platform.close();
    clearInterval(this.ticking);
    this.streams.forEach((each) => each.close());
  }

  /** Subscribes to the topics of all domains to measure delays. */
  subscribe() {
    for (const domain of store.domains.keys()) {
      if (!this.streams.has(domain)) {
        this.streams.set(domain, streams.subscribe(`data.${domain}.realtime`, { mode: 'latest', prime: false, createdLater: true }, {
          records: (records) => records.forEach((record) => this.delays.add(record, Date.now())),
        }));
      }
    }
  }

  draw() {
    const { value, error } = this.platform;
    if (error) {
      this.drawIfChanged(error.message, () => [h('p.error-note', null, icon('warning'), error.message)]);
      value || this.drawUnknown(['parts', 'groups', 'letters']);
      return;
    }
    const isKafkaDown = value.kafka?.state === 'away';
    const parts = Object.entries(value.controlPlane.parts ?? {});
    const letters = value.deadLetters.filter((each) => each.records > 0);
    const behind = value.groups.filter((each) => each.lag > MAX_LAG);
    const faults = [
      ...(isKafkaDown ? [value.kafka.reason] : []),
      ...(value.controlPlane.status === 'away' ? [value.controlPlane.reason] : []),
      ...(value.controlPlane.warnings ?? []),
      ...parts.filter(([, part]) => part.state !== 'up').map(([name, part]) => t('platform.partDown', { part: nameOf(name), state: part.state, detail: part.detail ?? '' })),
      ...behind.map((each) => t('platform.behind', { group: each.group, lag: number(each.lag) })),
      ...(letters.length ? [t('platform.hasLetters', { count: number(letters.reduce((sum, each) => sum + each.records, 0)), topics: letters.length })] : []),
    ];
    this.drawIfChanged(JSON.stringify(faults), () => (faults.length === 0
      ? [h('p.row.all-well', null, icon('check'), h('strong', null, t('platform.well')))]
      : [h('h2', null, t('platform.wrong')), h('ul.stack', null, faults.map((each) => h('li.error-note.warn-note', null, icon('warning', 18), each)))]));
    this.drawParts(parts);
    if (isKafkaDown) {
      this.drawUnknown(['groups', 'letters']);
      return;
    }
    this.drawGroups(value.groups);
    this.drawLetters(value.deadLetters, letters);
  }

  drawUnknown(panels) {
    panels.forEach((each) => replace(this[each], h('h2', null, t(`platform.${each === 'groups' ? 'lag' : each}`)), h('p.muted', null, t('platform.notKnown'))));
  }

  /** Redraws the live region only if its content changed. */
  drawIfChanged(key, draw) {
    if (key !== this.drawn) {
      this.drawn = key;
      replace(this.wrong, draw());
    }
  }

  drawParts(parts) {
    replace(this.parts, h('h2', null, t('platform.parts')), parts.length === 0 ? h('p.muted', null, t('platform.notKnown')) : h('ul.platform-parts', null, parts.map(([name, part]) => h('li', null,
      h('span', { class: `pill ${part.state === 'up' ? 'good' : 'bad'}` }, t(`platform.states.${part.state}`)), h('span.cut', null, nameOf(name)), h('span.small.muted', null, part.detail ?? '')))));
  }

  drawGroups(groups) {
    const longest = Math.max(MAX_LAG, ...groups.map((each) => each.lag));
    const row = (each) => {
      const filled = h('span');
      filled.style.width = `${100 * each.lag / longest}%`;
      return h('li', null, h('span.cut', { title: each.group }, each.group), h('span.bar', { class: each.lag > MAX_LAG ? 'much' : '', 'aria-hidden': 'true' }, filled), h('span.numbers', null, number(each.lag)));
    };
    const isQuiet = (each) => OF_REPLAY.test(each.group) && each.lag <= MAX_LAG;
    const quiet = groups.filter(isQuiet);
    const open = this.groups.querySelector('details')?.open;
    replace(this.groups, h('h2', null, t('platform.lag')), h('p.small.muted', null, t('platform.lagHint')),
      groups.length === 0 ? h('p.muted', null, t('platform.noGroups')) : h('ul.lags', null, groups.filter((each) => !isQuiet(each)).map(row)),
      quiet.length > 0 && h('details', { open }, h('summary.small.muted', null, t('platform.ofReplays', { count: quiet.length })), h('ul.lags', null, quiet.map(row))));
  }

  drawLetters(all, letters) {
    replace(this.letters, h('h2', null, t('platform.letters')),
      letters.length === 0
        ? h('p.row.muted', null, icon('check', 18), t('platform.noLetters', { count: all.length }))
        : [h('ul.lags', null, letters.map((each) => h('li', null, h('span.cut', null, each.topic), h('span'), h('span.numbers', null, number(each.records))))), h('p.small.muted', null, t('platform.lettersHint')), h('pre.letters-command', { tabindex: '0', role: 'group', 'aria-label': t('platform.lettersCommand') }, letters.map((each) => `./furrow dead-letters redrive --topic ${each.topic}`).join('\n'))]);
  }

  /** Draws all hops on one time axis, so that each contribution is visible. */
  drawHops() {
    const summary = this.delays.summary(Date.now());
    const title = h('div.row', null, h('h2', null, t('platform.hops')), h('span.spacer'), h('span.small.muted.numbers', null, summary ? t('platform.samples', { count: this.delays.count }) : ''));
    if (!summary) {
      replace(this.hops, title, h('p.muted', null, t('platform.hopsWait')));
      return;
    }
    const longest = Math.max(...summary.map((each) => each.p99), 10);
    let offset = 0;
    replace(this.hops, title, h('div.hops', { role: 'table', 'aria-label': t('platform.hops') },
      h('div.hop.hop-head', { role: 'row' }, ['hop', 'axis', 'p50', 'p95', 'p99'].map((name) => h('span', { role: 'columnheader', class: name.startsWith('p') ? 'numbers' : '' }, name === 'hop' ? t('platform.hop') : name === 'axis' ? h('span.visually-hidden', null, t('platform.axis')) : `${name}, ms`))),
      summary.map((hop) => {
        const isAll = hop.name === 'all';
        const from = isAll ? 0 : offset;
        offset += hop.p50;
        return h('div', { role: 'row', class: `hop${isAll ? ' hop-all' : ''}` },
          h('span', { role: 'rowheader' }, t(`platform.hopNames.${hop.name}`)),
          h('span.hop-axis', { role: 'cell', 'aria-hidden': 'true' }, segment('p99', from, hop.p99, longest), segment('p95', from, hop.p95, longest), segment('p50', from, hop.p50, longest)),
          [hop.p50, hop.p95, hop.p99].map((each) => h('span.numbers', { role: 'cell' }, Math.round(each))));
      })),
    h('p.small.muted', null, t('platform.hopsHint')));
  }
}

function segment(kind, from, length, longest) {
  const bar = h('i', { class: kind });
  bar.style.left = `${Math.min(100, 100 * from / longest)}%`;
  bar.style.width = `${Math.max(0.4, Math.min(100 - 100 * from / longest, 100 * length / longest))}%`;
  return bar;
}

function nameOf(part) {
  return texts.platform.partNames[part] ?? label(part.replaceAll('-', ' '));
}

customElements.define('furrow-platform', FurrowPlatform);
