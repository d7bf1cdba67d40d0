/** The list of alarms, with commands, announcements and notifications. */
import { api } from '../core/api.js';
import { age, clock, label, readable } from '../core/format.js';
import { h, replace, setText } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { isIn, scope } from '../core/identities.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { arrange, isMuted } from './order.js';

const MUTES = [['PT10M', 'alarms.mute10'], ['PT1H', 'alarms.mute60'], ['PT8H', 'alarms.mute480']];
const SHOWN = 20;

class FurrowAlarms extends HTMLElement {
  connectedCallback() {
    this.failures = new Map();
    this.announced = null;
    this.count = h('span.numbers');
    this.list = h('ul.alarm-list');
    this.fold = h('details.alarm-fold', { hidden: true }, h('summary'), h('ul.alarm-list'));
    this.none = h('p.alarm-none', null, icon('check', 18), h('span', null, t('alarms.reading')));
    this.liveNote = h('p.small.muted', { hidden: true }, t('alarms.liveInReplay'));
    this.polite = h('div.visually-hidden', { 'aria-live': 'polite' });
    this.assertive = h('div.visually-hidden', { 'aria-live': 'assertive' });
    this.notify = h('button.button.quiet.small', { type: 'button', hidden: true, on: { click: () => this.requestPermission() } }, icon('bell', 16), t('alarms.notify'));
    replace(this, h('h2.section-title', null, h('span', null, t('alarms.title')), this.count), this.liveNote, this.none, this.list, this.fold, this.notify, this.polite, this.assertive);
    this.rows = new Map();
    this.subscriptions = [...['alarms', 'filter', 'fields'].map((name) => store.on(name, () => this.draw())), store.on('clock', () => this.drawAges()), store.on('mode', () => this.draw()), store.on('me', () => this.draw())];
    this.draw();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
  }

  draw() {
    const all = arrange(store.alarms.values(), Date.now());
    const [open, quiet] = [all.open.filter(isFound), all.quiet.filter(isFound)];
    const others = all.open.length - open.length;
    this.none.hidden = open.length > 0;
    this.none.classList.toggle('is-reading', !store.alarmsLoaded || others > 0);
    setText(this.none.lastChild, t(!store.alarmsLoaded ? 'alarms.reading' : others > 0 ? 'alarms.noMatch' : 'alarms.none'));
    this.liveNote.hidden = !store.isReplay;
    setText(this.count, store.alarmsLoaded ? t('alarms.open', { count: all.open.length }) : '');
    const used = new Set();
    this.fill(this.list, open.slice(0, SHOWN), used);
    this.fill(this.fold.lastChild, quiet.slice(0, SHOWN), used);
    this.fold.hidden = quiet.length === 0;
    setText(this.fold.firstChild, t('alarms.quiet', { count: quiet.length }));
    for (const id of this.rows.keys()) {
      used.has(id) || this.rows.delete(id);
    }
    this.notify.hidden = !('Notification' in window) || Notification.permission !== 'default';
    this.announce(all.open);
  }

  /** Updates a list. Rows retain their elements, so that a focused button is not removed. */
  fill(list, alarms, used) {
    const elements = alarms.map((alarm) => {
      used.add(alarm.alarm);
      const row = this.rows.get(alarm.alarm) ?? this.make(alarm.alarm);
      row.draw(alarm);
      return row.element;
    });
    // Removes first: a row that is moved closes its open menu.
    [...list.children].filter((each) => !elements.includes(each)).forEach((each) => each.remove());
    elements.forEach((element, index) => list.children[index] !== element && list.insertBefore(element, list.children[index] ?? null));
  }

  make(id) {
    const text = h('button.alarm-text', { type: 'button' });
    const line = h('p.small.muted.numbers');
    const acknowledge = h('button.button.small', { type: 'button' }, t('alarms.acknowledge'));
    const menu = h('div.alarm-menu', { popover: 'auto', id: `alarm-${id}` });
    const more = h('button.button.quiet.square.small', { type: 'button', 'aria-label': t('alarms.more'), popovertarget: menu.id }, icon('more', 18));
    const failed = h('p.small.failed', { role: 'alert', hidden: true });
    const actions = h('div.alarm-actions', null, acknowledge, more, menu);
    const element = h('li.alarm', null, h('div', null, text, line), actions, failed);
    const row = { element, line };
    acknowledge.addEventListener('click', () => this.act(row, 'acknowledge'));
    text.addEventListener('click', () => show(row.alarm));
    row.draw = (alarm) => {
      row.alarm = alarm;
      element.className = `alarm ${alarm.severity} ${alarm.state}${isMuted(alarm, Date.now()) || alarm.inhibitedBy ? ' quieted' : ''}`;
      setText(text, textOf(alarm));
      setText(line, lineOf(alarm));
      actions.hidden = !store.may('operate');
      acknowledge.hidden = alarm.state !== 'open';
      const muted = isMuted(alarm, Date.now());
      const key = `${muted}`;
      if (row.menuKey !== key) {
        row.menuKey = key;
        const choice = (words, command, body) => h('button.button.quiet.small', { type: 'button', on: { click: () => { menu.hidePopover(); this.act(row, command, body); } } }, words);
        replace(menu, muted ? choice(t('alarms.unmute'), 'unmute') : MUTES.map(([time, words]) => choice(t(words), 'mute', { for: time })), choice(t('alarms.close'), 'close'));
      }
      failed.hidden = !row.failure;
      setText(failed, row.failure ?? '');
    };
    this.rows.set(id, row);
    return row;
  }

  async act(row, command, body) {
    row.failure = null;
    try {
      await api.post(`/api/alarms/${encodeURIComponent(row.alarm.alarm)}/${command}`, body);
    } catch (error) {
      row.failure = error.message;
    }
    row.draw(row.alarm);
  }

  drawAges() {
    for (const row of this.rows.values()) {
      setText(row.line, lineOf(row.alarm));
    }
  }

  /** Announces alarms raised since the page was opened. */
  announce(open) {
    if (!store.alarmsLoaded) {
      return;
    }
    const ids = new Set(open.map((each) => each.alarm));
    if (this.announced) {
      for (const alarm of open.filter((each) => !this.announced.has(each.alarm))) {
        const place = alarm.severity === 'critical' ? this.assertive : this.polite;
        setText(place, t('alarms.announced', { severity: alarm.severity, text: textOf(alarm) }));
        showNotification(alarm);
      }
    }
    this.announced = ids;
  }

  async requestPermission() {
    await Notification.requestPermission();
    this.draw();
  }
}

/** The text with the names of devices and fields. */
function textOf(alarm) {
  return readable(alarm.text).replace(/\bfield ([\w-]+)/g, (words, id) => store.fields.get(id)?.name ?? words);
}

function isFound(alarm) {
  return store.isFound(textOf(alarm), label(alarm.kind.replaceAll('-', ' ')), alarm.subject ?? '');
}

function lineOf(alarm) {
  const now = Date.now();
  const parts = [label(alarm.kind.replaceAll('-', ' ')), age(now - alarm.raised)];
  alarm.count > 1 && parts.splice(1, 0, t('alarms.seen', { count: alarm.count }));
  alarm.affected > 1 && parts.splice(1, 0, t('alarms.affected', { count: alarm.affected, total: alarm.total ?? alarm.affected }));
  alarm.acknowledgedBy && parts.push(t('alarms.by', { user: alarm.acknowledgedBy }));
  parts.push(...new Set(entitiesOf(alarm).map(({ difference }) => difference).filter(Boolean)));
  isMuted(alarm, now) && parts.push(t('alarms.mutedUntil', { time: clock(alarm.mutedUntil) }));
  alarm.inhibitedBy && parts.push(t('alarms.inhibited'));
  return parts.join(' · ');
}

/** The entities of an alarm's devices. Alarms of an older control plane name neither tenant nor path. */
function entitiesOf(alarm) {
  return (alarm.devices ?? []).map(({ id, type, service, servicePath }) => {
    const of = scope(service, servicePath);
    const entity = store.entities.get(store.identities.keyOf(id, of, type ?? ''));
    return alarm.identity ? entity && isIn(entity.identity, of) && entity : entity ?? store.entities.get(store.identities.keyOfType(id, type));
  }).filter(Boolean);
}

/** Shows the first device of an alarm on the map. */
function show(alarm) {
  const device = entitiesOf(alarm)[0]?.id ?? (!alarm.identity && store.entities.has(alarm.subject) ? alarm.subject : null);
  device && store.select(device, { reveal: true });
}

/** Shows a notification while the page is hidden. */
function showNotification(alarm) {
  if (document.hidden && 'Notification' in window && Notification.permission === 'granted' && (alarm.severity === 'critical' || alarm.severity === 'major')) {
    const shown = new Notification(t('alarms.notification', { severity: alarm.severity }), { body: textOf(alarm), tag: alarm.alarm });
    shown.onclick = () => { window.focus(); show(alarm); };
  }
}

customElements.define('furrow-alarms', FurrowAlarms);
