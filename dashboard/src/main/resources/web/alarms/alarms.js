/** The list of alarms, with commands, announcements and notifications. */
import { api } from '../core/api.js';
import { age, clock, label, word } from '../core/format.js';
import { language } from '../core/language.js';
import { h, isHeld, replace, setText } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { picturesAround } from '../core/router.js';
import { others } from '../core/scope.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { entitiesOf } from './entities.js';
import { arrange, isMuted } from './order.js';
import { isOfServer, sentenceOf } from './sentence.js';

const MUTES = [['PT10M', 'alarms.mute10'], ['PT1H', 'alarms.mute60'], ['PT8H', 'alarms.mute480']];
const SHOWN = 20;
/** Time for which the room of open alarms is retained when none is left, ms. */
const ROOM_MILLIS = 60_000;

class FurrowAlarms extends HTMLElement {
  connectedCallback() {
    this.announced = null;
    this.shown = SHOWN;
    this.lastOpen = -Infinity;
    this.count = h('span.numbers');
    this.list = h('ul.alarm-list');
    this.fold = h('details.alarm-fold', { hidden: true }, h('summary'), h('ul.alarm-list'));
    this.none = h('p.alarm-none', null, icon('check', 18), h('span', null, t('alarms.reading')));
    this.further = h('button.button.quiet.small', { type: 'button', hidden: true, on: { click: () => { this.shown += SHOWN; this.draw(); } } });
    this.elsewhere = h('div', { hidden: true });
    this.polite = h('div.visually-hidden', { 'aria-live': 'polite' });
    this.assertive = h('div.visually-hidden', { 'aria-live': 'assertive' });
    this.notify = h('button.button.quiet.square.small', { type: 'button', hidden: true, 'aria-label': t('alarms.notify'), title: t('alarms.notify'), on: { click: () => this.requestPermission() } }, icon('bell', 16));
    replace(this, h('div.alarm-head', null, h('h2.section-title', null, h('span', null, t('alarms.title')), this.count), this.notify), this.none, this.list, this.further, this.elsewhere, this.fold, this.polite, this.assertive);
    this.rows = new Map();
    this.list.addEventListener('pointerleave', () => this.draw());
    this.list.addEventListener('focusout', () => setTimeout(() => this.draw()));
    this.fold.addEventListener('toggle', () => { this.draw(); this.giveRoom(true); });
    this.subscriptions = [...['alarms', 'filter', 'fields', 'scope'].map((name) => store.on(name, () => this.draw())), store.on('clock', () => (store.scope.domain === null ? this.drawAges() : this.draw())), store.on('encounters', () => this.drawAges()), store.on('mode', () => this.draw()), store.on('me', () => this.draw())];
    this.draw();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
  }

  draw() {
    const all = arrange(store.alarms.values(), Date.now());
    // alarms are live: a replay shows them in one line
    const [open, quiet] = (store.isReplay ? [[], [...all.open, ...all.quiet]] : [all.open, all.quiet]).map((each) => each.filter(isFound).filter(isInScope));
    const hidden = store.isReplay ? 0 : all.open.length - open.length;
    const elsewhere = store.isReplay ? 0 : all.open.filter((each) => isFound(each) && !isInScope(each)).length;
    this.none.hidden = open.length > 0 || store.isReplay;
    this.none.classList.toggle('is-reading', !store.alarmsLoaded || hidden > 0 || Boolean(store.lists.alarms.error));
    const { error } = store.lists.alarms;
    setText(this.none.lastChild, error ? t('alarms.failed', { reason: error.message }) : t(!store.alarmsLoaded ? 'alarms.reading' : hidden > elsewhere ? 'alarms.noMatch' : hidden > 0 ? 'alarms.noneHere' : 'alarms.none'));
    setText(this.count, store.alarmsLoaded ? t('alarms.open', { count: all.open.length }) : '');
    const used = new Set();
    this.fill(this.list, open.slice(0, this.shown), used);
    this.fill(this.fold.lastChild, quiet.slice(0, this.shown), used);
    const further = Math.max(open.length, this.fold.open ? quiet.length : 0) - this.shown;
    this.further.hidden = further <= 0;
    setText(this.further, t('alarms.further', { count: further }));
    if (elsewhere !== this.elsewhere.count) {
      this.elsewhere.count = elsewhere;
      this.elsewhere.hidden = elsewhere === 0;
      replace(this.elsewhere, others(elsewhere));
    }
    this.fold.hidden = quiet.length === 0;
    setText(this.fold.firstChild, t(store.isReplay ? 'alarms.liveInReplay' : 'alarms.quiet', { count: quiet.length }));
    this.counts = [open.length, quiet.length];
    this.giveRoom();
    for (const id of this.rows.keys()) {
      used.has(id) || this.rows.delete(id);
    }
    this.notify.hidden = !('Notification' in window) || Notification.permission !== 'default';
    this.announce(all.open);
  }

  /** Sizes the region in two steps, and by itself not while a hand is on the panel, so that the cards below do not move under it. */
  giveRoom(now = !this.dataset.room) {
    const [open, quiet] = this.counts;
    this.lastOpen = open > 0 ? Date.now() : store.isReplay ? -Infinity : this.lastOpen;
    const room = open > 0 || (quiet > 0 && this.fold.open) || Date.now() - this.lastOpen < ROOM_MILLIS ? 'many' : 'few';
    if (room !== this.dataset.room && (now || !isHeld(this.parentElement))) {
      this.dataset.room = room;
    }
  }

  /** Updates a list. Rows retain their elements, so that a focused button is not removed; under a hand none moves. */
  fill(list, alarms, used) {
    const elements = alarms.map((alarm) => {
      used.add(alarm.alarm);
      const row = this.rows.get(alarm.alarm) ?? this.make(alarm.alarm);
      row.draw(alarm);
      return row.element;
    });
    if (isHeld(list)) {
      [...list.children].filter((each) => each.matches('.alarm') && !elements.includes(each)).forEach(leaveGap);
      list.append(...elements.filter((each) => each.parentElement !== list));
      return;
    }
    // Removes first: a row that is moved closes its open menu.
    [...list.children].filter((each) => !elements.includes(each)).forEach((each) => each.remove());
    elements.forEach((element, index) => list.children[index] !== element && list.insertBefore(element, list.children[index] ?? null));
  }

  make(id) {
    const text = h('button.alarm-text', { type: 'button' });
    const line = h('span');
    const around = h('a', { hidden: true }, t('history.around'));
    const acknowledge = h('button.button.small', { type: 'button' }, t('alarms.acknowledge'));
    const menu = h('div.alarm-menu', { popover: 'auto', id: `alarm-${id}` });
    const more = h('button.button.quiet.square.small', { type: 'button', 'aria-label': t('alarms.more'), popovertarget: menu.id }, icon('more', 18));
    const failed = h('p.small.failed', { role: 'alert', hidden: true });
    const actions = h('div.alarm-actions', null, acknowledge, more, menu);
    const element = h('li.alarm', null, h('div', null, text, h('p.small.muted.numbers', null, line, ' ', around)), actions, failed);
    const row = { element, line, text };
    acknowledge.addEventListener('click', () => this.act(row, 'acknowledge'));
    text.addEventListener('click', () => show(row.alarm));
    row.draw = (alarm) => {
      row.alarm = alarm;
      element.className = `alarm ${alarm.severity} ${alarm.state}${isMuted(alarm, Date.now()) || alarm.inhibitedBy ? ' quieted' : ''}`;
      setText(text, sentenceOf(alarm));
      text.lang = isOfServer(alarm) ? 'en' : language;
      acknowledge.setAttribute('aria-label', `${t('alarms.acknowledge')}: ${sentenceOf(alarm)}`);
      more.setAttribute('aria-label', `${t('alarms.more')}: ${sentenceOf(alarm)}`);
      setText(line, lineOf(alarm));
      const device = alarm.kind === 'collision' && entitiesOf(alarm)[0];
      around.hidden = !device;
      device && (around.href = picturesAround(device.id, alarm.raised, alarm.raised));
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

  /** Updates what changes without a record of the alarm: its age, and the distance of its encounter. */
  drawAges() {
    for (const row of this.rows.values()) {
      setText(row.text, sentenceOf(row.alarm));
      setText(row.line, lineOf(row.alarm));
    }
    this.giveRoom();
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
        setText(place, t('alarms.announced', { severity: word(alarm.severity ?? ''), text: sentenceOf(alarm) }));
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

/** Leaves the place of a row empty, with its focus, until the pointer and the focus are elsewhere. */
function leaveGap(row) {
  const gap = h('li.alarm-gap', { tabindex: '-1' });
  const focused = row.contains(document.activeElement);
  gap.style.height = `${row.getBoundingClientRect().height}px`;
  row.replaceWith(gap);
  focused && gap.focus({ preventScroll: true });
}

function isFound(alarm) {
  return store.isFound(sentenceOf(alarm), label(alarm.kind.replaceAll('-', ' ')), alarm.subject ?? '');
}

/** An alarm of no device that the page knows concerns all. */
function isInScope(alarm) {
  return store.isAboutScope(entitiesOf(alarm));
}

function lineOf(alarm) {
  const now = Date.now();
  const parts = [label(alarm.severity ?? ''), label(alarm.kind.replaceAll('-', ' '))].filter(Boolean);
  alarm.affected > 1 && parts.push(t('alarms.affected', { count: alarm.affected, total: alarm.total ?? alarm.affected }));
  alarm.count > 1 && parts.push(t('alarms.seen', { count: alarm.count }));
  parts.push(age(now - alarm.raised));
  alarm.acknowledgedBy && parts.push(t('alarms.by', { user: alarm.acknowledgedBy }));
  parts.push(...new Set(entitiesOf(alarm).map(({ difference }) => difference).filter(Boolean)));
  isMuted(alarm, now) && parts.push(t('alarms.mutedUntil', { time: clock(alarm.mutedUntil) }));
  alarm.inhibitedBy && parts.push(t('alarms.inhibited'));
  return parts.join(' · ');
}

/** Shows the first device of an alarm on the map. */
function show(alarm) {
  const device = entitiesOf(alarm)[0]?.id ?? (!alarm.identity && store.entities.has(alarm.subject) ? alarm.subject : null);
  device && store.select(device, { reveal: true });
}

/** Shows a notification while the page is hidden. */
function showNotification(alarm) {
  if (document.hidden && 'Notification' in window && Notification.permission === 'granted' && (alarm.severity === 'critical' || alarm.severity === 'major')) {
    const shown = new Notification(t('alarms.notification', { severity: word(alarm.severity) }), { body: sentenceOf(alarm), tag: alarm.alarm });
    shown.onclick = () => { window.focus(); show(alarm); };
  }
}

customElements.define('furrow-alarms', FurrowAlarms);
