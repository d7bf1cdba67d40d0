/** Shows a mission: its progress, its devices, and the commands sent to it. */
import { detailOf } from '../../alarms/sentence.js';
import { api } from '../../core/api.js';
import { csvButton, dateOf } from '../../core/csv.js';
import { age, dateTime, duration, readable, shortId, word } from '../../core/format.js';
import { h, replace } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { linkTo, navigate } from '../../core/router.js';
import { resource } from '../../core/resource.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { auditTable } from './audit.js';
import { checkPlan, farmNow } from './check.js';
import { showCredentials } from './credentials.js';
import { openDialog } from '../../core/dialog.js';
import { findingsList, summaryOf } from './findings.js';
import { statePill } from './list.js';
import { redraw } from '../../core/redraw.js';

const MAX_SHOWN = 200;
/** A device of a stopped mission is off once it has not reported for this time, ms. */
const OFF_AFTER = 60_000;

/** Of devices, for their CSV. */
const COLUMNS = [
  { name: 'missions.deviceColumns.device', value: ({ id }) => shortId(id) },
  { name: 'report.id', value: ({ id }) => id },
  { name: 'report.type', value: ({ type }) => type },
  { name: 'missions.deviceColumns.state', value: ({ status }) => status?.state },
  { name: 'missions.deviceColumns.health', value: (device) => healthOf(device, Date.now())[1] },
  { name: 'missions.deviceColumns.battery', unit: 'percent', value: ({ health }) => (typeof health?.battery === 'number' ? Math.round(health.battery * 100) : null) },
  { name: 'missions.deviceColumns.seen', value: (device) => dateOf(seenAt(device) || NaN) },
];

export class MissionDetail {
  /** @param {string} name of the mission */
  constructor(name, onDeleted) {
    this.name = name;
    this.onDeleted = onDeleted;
    this.head = h('div.stack');
    this.failure = h('div', { role: 'alert' });
    this.devices = h('div.stack');
    this.audit = auditTable({ mission: name, limit: 20 });
    this.element = h('section.panel.mission-detail', { 'aria-label': name, tabindex: '-1' }, this.head, this.failure, this.devices,
      h('h3.section-title', null, t('missions.audit')), this.audit.element);
    const path = encodeURIComponent(name);
    this.mission = resource(`/api/missions/${path}`, { topics: ['service.missions', 'service.missions.status'], interval: 10_000 });
    this.list = resource(`/api/devices?mission=${path}`, { topics: ['service.devices', 'service.devices.status'], interval: 5_000 });
    this.subscriptions = [this.mission.on(() => this.draw()), this.list.on(() => this.draw()), store.on('me', () => this.draw())];
    replace(this.head, h('h2', null, name), h('div.skeleton', null, '…'));
  }

  draw() {
    const mission = this.mission.value;
    if (this.mission.error) {
      replace(this.head, h('h2', null, this.name), h('p.error-note', { role: 'alert' }, icon('warning'), this.mission.error.message));
      return;
    }
    if (!mission) {
      return;
    }
    const status = mission.status;
    redraw(this.head,
      h('div.row.wrap', null, h('h2', null, this.name), statePill(status?.state), h('span.spacer'), h('div.row.wrap', null, this.buttons(mission))),
      h('p.small.muted', null, [mission.domain, mission.template, mission.start && t('missions.startedAt', { time: dateTime(mission.start) }), mission.duration && t('missions.lasts', { duration: duration(mission.duration) }), leftOf(mission)].filter(Boolean).join(' · ')),
      status?.reason && status.missing.length === 0 && h('p.error-note', null, icon('warning'), status.reason),
      status && mission.running && h('div.stack', null,
        h('div.row', null, h('span.numbers', null, t('missions.confirmed', { confirmed: status.confirmed, devices: status.devices })), h('span.spacer'), status.missing.length > 0 && h('span.warn', null, t('missions.missing', { count: status.devices - status.confirmed }))),
        h('div.bar', { role: 'progressbar', 'aria-valuemin': 0, 'aria-valuemax': status.devices, 'aria-valuenow': status.confirmed, 'aria-label': t('missions.progress') }, bar(status))),
      this.missing(status));
    this.drawDevices(mission);
  }

  missing(status) {
    return status?.missing.length > 0 && h('ul.findings', null, status.missing.map((each) => h('li.finding.is-warning', null, icon('warning', 18),
      h('div', null, h('strong', null, shortId(each.id)), h('p.small', null, detailOf(each) ?? readable(each.reason ?? t('missions.notYet')))))));
  }

  buttons(mission) {
    const onMap = t('topics.showOnly', { name: this.name });
    const map = h('button.button.square', { type: 'button', data: { act: 'map' }, 'aria-label': onMap, title: onMap, on: { click: () => { store.setScope({ domain: mission.domain, mission: this.name }); navigate('map'); } } }, icon('map', 18));
    const report = h('a.button', { href: linkTo('report', { mission: this.name }), data: { act: 'report' } }, icon('list', 16), t('missions.report'));
    if (!store.may('operate')) {
      return [map, report];
    }
    const running = mission.running;
    const button = (act, symbol, words, work, kind = '') => h('button.button', { type: 'button', class: kind, data: { act }, on: { click: work } }, icon(symbol, 16), words);
    const recorded = store.recordings.has(this.name);
    return [
      map,
      running ? button('stop', 'stop', t('missions.stop'), () => this.confirmStop()) : button('start', 'play', t('missions.start'), () => this.confirmStart(mission), 'primary'),
      running && store.may('administer') && button('credentials', 'link', t('missions.credentials'), () => showCredentials(this.name)),
      recorded && h('a.button', { href: linkTo('replays', { mission: this.name }), data: { act: 'replay' } }, icon('history', 16), t('missions.replay')),
      report,
      !running && button('delete', 'trash', t('missions.delete'), () => this.confirmDelete(), 'danger'),
    ];
  }

  confirmStart(mission) {
    const checked = checkPlan(mission.devices ?? [], mission.domain, farmNow(this.name));
    openDialog({
      title: t('missions.startTitle', { mission: this.name }), body: [h('h3', null, summaryOf(checked)), findingsList(checked)], submit: t('missions.start'),
      work: () => api.post(`/api/missions/${encodeURIComponent(this.name)}/start`),
    });
  }

  confirmStop() {
    openDialog({
      title: t('missions.stopTitle', { mission: this.name }), body: [h('p', null, t('missions.stopText'))], submit: t('missions.stop'), danger: true,
      work: () => api.post(`/api/missions/${encodeURIComponent(this.name)}/stop`),
    });
  }

  confirmDelete() {
    openDialog({
      title: t('missions.deleteTitle', { mission: this.name }), body: [h('p', null, t('missions.deleteText'))], submit: t('missions.delete'), danger: true,
      work: async () => { await api.del(`/api/missions/${encodeURIComponent(this.name)}`); this.onDeleted(); },
    });
  }

  drawDevices(mission) {
    const devices = this.list.value;
    if (this.list.error || !devices) {
      redraw(this.devices, this.list.error ? h('p.error-note', null, icon('warning'), this.list.error.message) : h('div.skeleton', null, '…'));
      return;
    }
    if (devices.length === 0) {
      redraw(this.devices, h('p.muted', null, mission.running ? t('missions.noDevicesYet') : t('missions.planned', { count: mission.deviceCount ?? 0 })));
      return;
    }
    const now = Date.now();
    redraw(this.devices, h('div.row', null, h('h3.section-title.spacer', null, h('span', null, t('missions.devices')), h('span.numbers', null, devices.length)), csvButton(t('missions.devices'), `${this.name}-devices`, COLUMNS, () => this.list.value)),
      h('div.table-frame.device-table', { tabindex: '0', role: 'group', 'aria-label': t('missions.devices') }, h('table.table', null,
        h('thead', null, h('tr', null, ['device', 'state', 'health', 'battery', 'seen', 'audit'].map((name) => h('th', { scope: 'col', class: name === 'battery' || name === 'seen' ? 'numbers' : '' }, t(`missions.deviceColumns.${name}`))))),
        h('tbody', null, devices.slice(0, MAX_SHOWN).map((each) => this.row(each, now))))),
      devices.length > MAX_SHOWN && h('p.small.muted', null, t('missions.moreDevices', { count: devices.length - MAX_SHOWN })));
  }

  row(device, now) {
    const health = device.health ?? {};
    const state = device.status?.state ? word(device.status.state, 'reported') : t('missions.notYet');
    const seen = seenAt(device);
    const sound = healthOf(device, now);
    return h('tr', null,
      h('th', { scope: 'row' }, h('button.sort', { type: 'button', data: { act: device.id }, title: t('missions.onMap', { device: shortId(device.id) }), on: { click: () => { const key = store.entityOf(device)?.id ?? device.id; store.select(key, { reveal: true }); navigate('map', { select: key }); } } }, shortId(device.id))),
      h('td', { class: device.status?.state === 'failed' ? 'bad' : '' }, state, device.status?.reason && h('p.small.muted', null, device.status.reason)),
      h('td', { class: sound[0] }, sound[1]),
      h('td.numbers', null, typeof health.battery === 'number' ? `${Math.round(health.battery * 100)} %` : '–'),
      h('td.numbers', null, seen ? age(now - seen) : '–'),
      h('td.right', null, h('a.button.quiet.square.small', { href: linkTo('missions', { tab: 'audit', device: device.id }), data: { act: `audit ${device.id}` }, 'aria-label': t('missions.auditOfDevice', { device: shortId(device.id) }), title: t('missions.auditOfDevice', { device: shortId(device.id) }) }, icon('list', 16))));
  }

  close() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.mission.close();
    this.list.close();
    this.audit.close();
  }
}

/** When a device was last heard, epoch ms; 0 if never. */
function seenAt(device) {
  return Math.max(device.health?.heard ?? device.health?.lastSeen ?? 0, (!store.isReplay && store.entityOf(device)?.heard) || 0);
}

/** The class and the words of a device's health. */
function healthOf(device, now) {
  const seen = seenAt(device);
  const isOff = device.health?.off || (device.wanted === 'stopped' && now - seen > OFF_AFTER);
  return isOff ? ['muted', t('states.off')] : device.health?.silent ? ['warn', t('states.stale')] : seen ? ['good', t('states.ok')] : ['muted', '–'];
}

/** How long a running mission still lasts, if its length is known. */
function leftOf({ running, start, duration: length }) {
  const left = running && start && length ? start + length - Date.now() : 0;
  return left > 0 && t('missions.left', { duration: duration(left) });
}

function bar(status) {
  const span = h('span');
  span.style.width = `${status.devices ? 100 * status.confirmed / status.devices : 0}%`;
  return span;
}
