/** Shows the audit: which user sent which command when. */
import { api } from '../../core/api.js';
import { csvButton, dateOf } from '../../core/csv.js';
import { dateTime, duration, moment, plain, readable, shortId, word } from '../../core/format.js';
import { h } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { linkTo, navigate } from '../../core/router.js';
import { resource } from '../../core/resource.js';
import { store } from '../../core/store.js';
import { refusal, t } from '../../texts.js';
import { redraw } from '../../core/redraw.js';

/** Of the entries of the audit. */
const COLUMNS = [
  { name: 'missions.auditColumns.time', value: (entry) => dateOf(entry.time) },
  { name: 'missions.auditColumns.user', value: (entry) => entry.user },
  { name: 'missions.auditColumns.command', value: (entry) => `${t(`missions.targets.${TARGETS[entry.target] ?? 'other'}`)} ${word(entry.command ?? '')}` },
  { name: 'missions.auditColumns.about', value: ({ about }) => wordsOf(about ?? {}) },
  { name: 'missions.auditColumns.result', value: resultOf },
];

const POLL_MILLIS = 4_000;
const TARGETS = { __proto__: null, 'service.missionmanager': 'mission', 'service.domainmanager': 'domain', 'service.replaymanager': 'replay', 'service.alarmmanager': 'alarm', 'service.fields': 'field', device: 'device', marker: 'marker' };

/** Maximum number of pages read per click if they have no matching entries. */
const MAX_PAGES = 5;

/** Reads a page of the audit. @returns {Promise<{entries: object[], older: string|null}>} `older` is the path of the next page, if there is one */
async function page(path) {
  const response = await api.fetch(path);
  const next = /<([^>]+)>; ?rel="?next"?/.exec(response.headers.get('Link') ?? '');
  return { entries: await response.json(), older: next && path.replace(/\?.*/, next[1]) };
}

/** A table of commands that is refreshed and loads older ones on request. @param {{mission: string=, device: string=, limit: number=}} filter */
export function auditTable({ mission, device, limit = 50 } = {}) {
  const query = new URLSearchParams({ limit: String(limit), ...(mission ? { mission } : {}), ...(device ? { device } : {}) });
  const list = resource(`/api/audit?${query}`, { interval: POLL_MILLIS, read: page });
  const place = h('div.stack', null, [0, 1, 2].map(() => h('div.skeleton', null, '…')));
  let entries = [];
  let older = null;
  let extended = false;
  let reading = false;
  let failure = null;
  let closed = false;
  let shown = null;
  const off = list.on(() => {
    if (!list.error) {
      merge(list.value);
    }
    draw();
  });

  /** Adds the newest page to older ones that were loaded; drops those if there is a gap between them. */
  function merge(newest) {
    const newestShown = entries[0]?.position ?? -1;
    const reaches = newest.older === null || !newest.entries.length || newest.entries.at(-1).position <= newestShown || newestShown < 0;
    if (extended && reaches) {
      entries = [...newest.entries.filter((each) => each.position > newestShown), ...entries];
    } else {
      ({ entries, older } = newest);
      extended = false;
    }
  }

  async function showOlder() {
    reading = true;
    failure = null;
    draw();
    try {
      for (let pages = 0, found = 0; older && !found && pages < MAX_PAGES && !closed; pages++) {
        const next = await page(older);
        entries = [...entries, ...next.entries];
        ({ older } = next);
        extended = true;
        found = next.entries.length;
      }
    } catch (error) {
      failure = error.message;
    }
    reading = false;
    closed || draw();
  }

  function draw() {
    const drawn = JSON.stringify([list.error?.message, entries, older, extended, reading, failure]);
    if (drawn === shown) {
      return;
    }
    shown = drawn;
    if (list.error) {
      redraw(place, h('p.error-note', { role: 'alert' }, icon('warning'), list.error.message));
    } else {
      redraw(place, entries.length ? table() : h('p.muted', null, t(older ? 'missions.noAuditYet' : mission || device ? 'missions.noAuditOf' : 'missions.noAudit')), foot());
    }
  }

  function table() {
    return h('div.table-frame.audit-table', { tabindex: '0', role: 'group', 'aria-label': t('missions.audit') }, h('table.table', { role: 'table' },
      h('thead', null, h('tr', null, ['time', 'user', 'command', 'about', 'result'].map((name) => h('th', { scope: 'col' }, t(`missions.auditColumns.${name}`))))),
      h('tbody', null, entries.map(row))));
  }

  function foot() {
    const name = [t('missions.audit'), mission, device && shortId(device)].filter(Boolean).join(' · ');
    return [
      failure && h('p.error-note', { role: 'alert' }, icon('warning'), failure),
      older
        ? h('div', null, h('button.button.quiet', { type: 'button', data: { act: 'audit-older' }, 'aria-disabled': String(reading), on: { click: () => reading || showOlder() } }, t(reading ? 'missions.readingOlder' : 'missions.showOlder')))
        : extended && h('p.muted', null, t('missions.noOlder')),
      entries.length > 0 && h('div', null, csvButton(name, ['audit', mission].filter(Boolean).join('-'), COLUMNS, () => entries)),
    ].filter(Boolean);
  }

  return { element: place, close: () => { closed = true; off(); list.close(); } };
}

/** The audit of all commands, or of those of a mission or device. */
export function auditView({ mission, device }) {
  const table = auditTable({ mission, device, limit: 200 });
  const choice = (name, values, chosen, words) => {
    const all = chosen && !values.includes(chosen) ? [chosen, ...values] : values;
    return h('label.audit-choice', null, t(`missions.auditOf.${name}`), h('select', {
      data: { act: `audit-${name}` }, on: { change: ({ target }) => navigate('missions', { tab: 'audit', [name]: target.value || null }) },
    }, h('option', { value: '' }, t('missions.auditOf.all')), all.map((each) => h('option', { value: each, selected: each === chosen }, words(each)))));
  };
  const element = h('div.stack', null,
    h('div.row.wrap', null, choice('mission', [...store.missions.keys()].sort(), mission, (each) => each), choice('device', [...new Set([...store.devices.values()].map((each) => each.id))].sort(), device, shortId)),
    table.element);
  return { element, close: table.close };
}

function row(entry) {
  return h('tr', null,
    h('td.numbers.when', null, moment(entry.time)),
    h('td.who', null, entry.user),
    h('td.command', null, t(`missions.targets.${TARGETS[entry.target] ?? 'other'}`), ' ', h('strong', null, word(entry.command ?? '–'))),
    h('td.about', null, aboutOf(entry.about)),
    h('td', { class: isRejected(entry) ? 'bad' : '' }, resultOf(entry)));
}

function isRejected({ error, result }) {
  return error !== undefined || result === 'error';
}

function resultOf(entry) {
  return isRejected(entry) ? t('missions.refusedBecause', { reason: refusal(entry.error, readable(entry.reason ?? entry.error)) }) : word(plain(entry.result));
}

function aboutOf(about = {}) {
  const { device, mission, ...rest } = about;
  const words = wordsOf(rest);
  return [
    typeof mission === 'string' && h('a', { href: linkTo('missions', { mission }) }, mission),
    typeof device === 'string' && h('a', { href: linkTo('map', { select: device }) }, shortId(device)),
    words && h('span.muted', null, words.length > 160 ? `${words.slice(0, 160)}…` : words),
  ].filter(Boolean).flatMap((each, index) => (index ? [' · ', each] : [each]));
}

function wordsOf(about) {
  return Object.entries(about).map(([name, value]) => `${word(name)} ${textOf(name, value)}`).join(', ');
}

/** Formats times of replays as event times, and lengths of missions. */
function textOf(name, value) {
  const [, days, hours, minutes, seconds] = (name === 'duration' && /^P(?:(\d+)D)?(?:T(?:(\d+)H)?(?:(\d+)M)?(?:([\d.]+)S)?)?$/.exec(value)) || [];
  const length = (((Number(days ?? 0) * 24 + Number(hours ?? 0)) * 60 + Number(minutes ?? 0)) * 60 + Number(seconds ?? 0)) * 1000;
  return length > 0 ? duration(length) : ['from', 'to', 'start', 'until'].includes(name) && Number.isFinite(value) && value > 1e11 ? dateTime(value) : plain(value);
}
