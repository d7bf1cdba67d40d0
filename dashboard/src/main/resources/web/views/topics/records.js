/** Shows the newest records of the chosen topics as they arrive. */
import { bytes, clock, plain, shortId } from '../../core/format.js';
import { h, replace, setText } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { streams } from '../../core/stream.js';
import { t } from '../../texts.js';

const MAX_STORED = 200;
const MAX_SHOWN = 100;
const REDRAW_MILLIS = 300;
const MAX_TEXT = 20_000;

export class Records {
  constructor() {
    this.streams = new Map();
    this.records = [];
    this.open = new Set();
    this.key = '';
    this.paused = false;
    this.body = h('tbody');
    this.note = h('p.small.muted', { role: 'status' });
    this.pause = h('button.button.small', { type: 'button', 'aria-pressed': 'false', on: { click: () => this.togglePause() } }, icon('pause', 16), t('topics.pause'));
    this.find = h('input', { type: 'search', placeholder: t('topics.findKey'), 'aria-label': t('topics.findKey'), on: { input: () => { this.key = this.find.value.trim().toLowerCase(); this.draw(); } } });
    this.hint = h('div.empty', null, h('h3', null, t('topics.noneChosen')), h('p', null, t('topics.noneChosenHint')));
    this.frame = h('div.table-frame', { tabindex: '0', role: 'group', 'aria-label': t('topics.records') }, h('table.table.records', null,
      h('thead', null, h('tr', null, ['time', 'topic', 'key', 'value'].map((name) => h('th', { scope: 'col' }, t(`topics.columns.${name}`))))), this.body));
    this.bar = h('div.row.wrap', null, this.pause, h('div.find-key', null, this.find), h('span.spacer'), this.note);
    this.element = h('section.stack.topic-records', { 'aria-label': t('topics.records') }, this.bar, this.hint, this.frame);
    this.draw();
  }

  /** @param {Set<string>} topics */
  choose(topics) {
    for (const [topic, stream] of this.streams) {
      if (!topics.has(topic)) {
        stream.close();
        this.streams.delete(topic);
        this.records = this.records.filter((each) => each.topic !== topic);
      }
    }
    for (const topic of topics) {
      this.streams.has(topic) || this.streams.set(topic, this.follow(topic));
    }
    this.draw();
  }

  follow(topic) {
    const subscription = { gap: 0, state: 'connecting', close: () => stream.close() };
    const stream = streams.subscribe(topic, { mode: 'all', prime: false }, {
      records: (records) => this.append(records),
      gap: (missed) => { subscription.gap += missed; this.schedule(); },
      state: (state, reason) => { Object.assign(subscription, { state, reason }); this.schedule(); },
    });
    return subscription;
  }

  append(records) {
    if (!this.paused) {
      this.records.push(...records);
      this.records.splice(0, this.records.length - MAX_STORED);
      this.schedule();
    }
  }

  schedule() {
    this.timer ??= setTimeout(() => { this.timer = null; this.draw(); }, REDRAW_MILLIS);
  }

  togglePause() {
    this.paused = !this.paused;
    this.pause.setAttribute('aria-pressed', String(this.paused));
    replace(this.pause, icon(this.paused ? 'play' : 'pause', 16), t(this.paused ? 'topics.goOn' : 'topics.pause'));
    this.draw();
  }

  draw() {
    const chosen = this.streams.size > 0;
    this.hint.hidden = chosen;
    this.frame.hidden = this.bar.hidden = !chosen;
    this.frame.classList.toggle('single', this.streams.size === 1);
    const shown = this.records.filter((each) => this.key === '' || String(each.key ?? '').toLowerCase().includes(this.key)).slice(-MAX_SHOWN).reverse();
    setText(this.note, this.stateOf(shown));
    const rows = [...this.body.children];
    const existingRows = new Map(rows.map((each) => [each.dataset.at, each]));
    const visible = shown.flatMap((record) => this.rowsOf(record, existingRows));
    visible.forEach((row, index) => this.body.children[index] !== row && this.body.insertBefore(row, this.body.children[index] ?? null));
    while (this.body.children.length > visible.length) {
      this.body.lastChild.remove();
    }
  }

  stateOf(shown) {
    const subscriptions = [...this.streams.values()];
    const failed = subscriptions.find((each) => each.state === 'refused' || each.state === 'waiting');
    const gaps = subscriptions.reduce((sum, each) => sum + each.gap, 0);
    const parts = [this.paused ? t('topics.paused') : shown.length === 0 && subscriptions.length > 0 ? t(this.key ? 'topics.noMatch' : 'topics.quiet') : t('topics.count', { count: shown.length })];
    gaps && parts.push(t('topics.gaps', { count: gaps }));
    failed && parts.push(failed.reason ?? t('topics.waiting'));
    return parts.join(' · ');
  }

  rowsOf(record, existingRows) {
    const at = `${record.topic} ${record.partition} ${record.offset}`;
    const open = this.open.has(at);
    const row = existingRows.get(at) ?? this.makeRow(record, at);
    row.querySelector('button').setAttribute('aria-expanded', String(open));
    return open ? [row, existingRows.get(`${at} open`) ?? openedRow(record, at)] : [row];
  }

  makeRow(record, at) {
    const button = h('button.sort.numbers', { type: 'button', 'aria-label': t('topics.open', { time: clock(record.time) }), on: { click: () => {
      this.open.has(at) ? this.open.delete(at) : this.open.add(at);
      this.draw();
    } } }, clock(record.time));
    return h('tr', { data: { at } }, h('td', null, button), h('td.cut.tail', { title: record.topic }, h('bdi', null, record.topic)), h('td.cut', { title: plain(record.key, 200) }, nameOf(plain(record.key, 160))), h('td.cut.value', null, lineOf(record)));
  }

  close() {
    clearTimeout(this.timer);
    this.streams.forEach((each) => each.close());
    this.streams.clear();
  }
}

function lineOf(record) {
  if (record.cut) {
    return t('topics.cut', { size: bytes(record.cut) });
  }
  if (record.value === null) {
    return t('topics.deleted');
  }
  const text = typeof record.value === 'string' ? record.value : JSON.stringify(isEntity(record.value) ? measuredOf(record.value) : record.value);
  return text.slice(0, 300);
}

function isEntity(value) {
  return typeof value === 'object' && typeof value.id === 'string' && typeof value.type === 'string';
}

/** The values of an entity's attributes; its id is in the key, and the opened row has all. */
function measuredOf({ id, type, ...attributes }) {
  return Object.fromEntries(Object.entries(attributes).map(([name, each]) => [name, each?.value ?? each]));
}

/** The key of a pair consists of both ids. */
function nameOf(key) {
  return key.split(/-(?=urn:)/).map(shortId).join(' – ');
}

function openedRow(record, at) {
  const value = record.cut ? t('topics.cut', { size: bytes(record.cut) }) : JSON.stringify(record.value, null, 2);
  const text = value.length > MAX_TEXT ? `${value.slice(0, MAX_TEXT)}\n… ${t('topics.shortened', { size: bytes(value.length) })}` : value;
  return h('tr.opened', { data: { at: `${at} open` } }, h('td', { colspan: 4 },
    h('p.small.muted.numbers', null, t('topics.where', { partition: record.partition, offset: record.offset, key: plain(record.key, 200) })),
    h('pre', null, text),
    Object.keys(record.headers ?? {}).length > 0 && h('details', null, h('summary.small', null, t('topics.headers')), h('pre', null, JSON.stringify(record.headers, null, 2)))));
}
