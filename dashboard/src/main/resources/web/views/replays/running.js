/** Lists running replays with their states, links and commands. */
import { dateOf } from '../../core/csv.js';
import { h, replace, setText } from '../../core/dom.js';
import { clock, readable, span } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { linkTo, navigate } from '../../core/router.js';
import { spanOf, store } from '../../core/store.js';
import { t } from '../../texts.js';
import { steer, stop } from '../../timeline/control.js';

const PILLS = { __proto__: null, running: 'good', paused: 'info', waiting: 'warn', starting: 'info', failed: 'bad', ended: '', stopped: '', over: '' };

/** Combines the replays of a group. @returns {{key: string, group: string|undefined, missions: string[], members: Object[]}[]} */
export function grouped(replays) {
  const byKey = new Map();
  for (const each of replays) {
    if (each.gone || !each.topic) {
      continue;
    }
    const key = each.group ?? each.replay;
    byKey.has(key) || byKey.set(key, { key, group: each.group, missions: [], members: [] });
    byKey.get(key).missions.push(each.mission);
    byKey.get(key).members.push(each);
  }
  return [...byKey.values()];
}

function stateOfReplay({ status }) {
  return !status ? 'starting' : status.state === 'running' && status.progress?.waiting ? 'waiting' : status.state;
}

/** Of the replays of a group or single ones, for their CSV. */
export const COLUMNS = [
  { name: 'replays.choice', value: ({ missions }) => missions.join(' + ') },
  { name: 'missions.columns.state', value: ({ members: [first] }) => t(`replays.states.${stateOfReplay(first)}`) },
  { name: 'analyses.from', value: ({ members }) => dateOf(spanOf(members).from) },
  { name: 'analyses.to', value: ({ members }) => dateOf(spanOf(members).to) },
  { name: 'replays.at', value: ({ members: [first] }) => dateOf(first.status?.progress?.position || NaN) },
  { name: 'replays.speed', value: ({ members: [first] }) => first.speed },
];

/** A link to a moment. If the replay no longer exists, the link offers to start one there. */
function linkToMoment({ replay, mission, group }, missions, time) {
  return new URL(linkTo('map', { replay, mission: (group ? missions : [mission]).join(), at: new Date(time).toISOString() }), location.href).href;
}

class RunningReplay {
  constructor(entry, announce) {
    this.announce = announce;
    this.name = h('h3');
    this.pill = h('span.pill');
    this.bar = h('span');
    this.progress = h('span.small.muted.numbers');
    this.reason = h('p.small.muted', { hidden: true });
    const button = (act, symbol, words, extra = '') => h(`button.button.small${extra}`, { type: 'button', on: { click: () => act.call(this) } }, icon(symbol, 16), words);
    this.watch = button(this.watchIt, 'play', t('replays.watch'));
    this.again = button(this.playAgain, 'history', t('replays.again'));
    this.link = button(this.copy, 'link', t('replays.copyLink'), '.quiet');
    this.end = button(this.stopIt, 'stop', t('replays.stop'), '.quiet');
    this.element = h('li.card.running', null,
      h('div.row', null, this.name, h('span.spacer'), this.pill), h('div.bar', null, this.bar), this.progress, this.reason,
      h('div.row.wrap', null, this.watch, this.again, this.link, h('span.spacer'), this.end));
    this.update(entry);
  }

  update(entry) {
    this.entry = entry;
    const [first] = entry.members;
    const state = stateOfReplay(first);
    const position = first.status?.progress?.position || undefined;
    const { from, to } = spanOf(entry.members);
    const watched = store.isReplay && (store.mode.replay === first.replay || (entry.group && store.mode.group === entry.group));
    const over = ['ended', 'stopped', 'failed'].includes(state);
    setText(this.name, entry.missions.join(' + '));
    this.pill.className = `pill ${PILLS[state] ?? ''}`;
    setText(this.pill, t(`replays.states.${state}`));
    const done = Number.isFinite(position) && to > from ? Math.min(1, Math.max(0, (position - from) / (to - from))) : 0;
    this.bar.style.width = `${(100 * done).toFixed(1)}%`;
    const values = { position: span((position ?? from ?? 0) - (from ?? 0)), length: span((to ?? 0) - (from ?? 0)), speed: first.speed };
    setText(this.progress, t(first.speed === 'max' ? 'replays.positionFast' : 'replays.position', values));
    const reason = first.status?.reason ?? first.status?.progress?.waiting;
    this.reason.hidden = !reason;
    setText(this.reason, readable(reason ?? ''));
    this.element.classList.toggle('watched', watched);
    setText(this.watch.lastChild, t(watched ? 'replays.watching' : 'replays.watch'));
    const may = store.may('operate');
    this.again.hidden = !over || !may;
    this.end.hidden = !may || (over && state !== 'ended'); // an ended replay stays until it is stopped or deleted
  }

  watchIt() {
    store.enterReplay(this.entry.members[0]);
    navigate('map');
  }

  async playAgain() {
    const [first] = this.entry.members;
    await this.attempt(() => steer(first, 'seek', { to: Math.max(first.status?.progress?.from ?? 0, first.from ?? 0, first.range?.from ?? 0) }));
    this.watchIt();
  }

  stopIt() {
    return this.attempt(() => stop(this.entry.members[0]));
  }

  async attempt(act) {
    try {
      await act();
    } catch (error) {
      this.announce(error.message);
    }
  }

  async copy() {
    const [first] = this.entry.members;
    const time = store.mode.replay === first.replay ? store.now() : first.status?.progress?.position ?? Date.now();
    const link = linkToMoment(first, this.entry.missions, time);
    try {
      await navigator.clipboard.writeText(link);
      this.announce(t('replays.copied', { time: clock(time) }));
    } catch {
      this.announce(t('replays.copyFailed', { link }));
    }
  }
}

/** Updates the list and retains existing elements, so that the focus is not lost. */
export function drawRunning(list, drawn, entries, announce) {
  for (const [key, each] of drawn) {
    if (!entries.some((entry) => entry.key === key)) {
      each.element.remove();
      drawn.delete(key);
    }
  }
  for (const entry of entries) {
    const existing = drawn.get(entry.key);
    if (existing) {
      existing.update(entry);
    } else {
      const created = new RunningReplay(entry, announce);
      drawn.set(entry.key, created);
      list.append(created.element);
    }
  }
  if (!entries.length) {
    replace(list);
  }
}
