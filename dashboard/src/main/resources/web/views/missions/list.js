/** Lists missions in scope, running ones first. */
import { dateOf } from '../../core/csv.js';
import { duration } from '../../core/format.js';
import { h } from '../../core/dom.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { redraw } from '../../core/redraw.js';
import { others } from '../../core/scope.js';

const ORDER = { __proto__: null, failed: 0, starting: 1, running: 1, stopping: 1, created: 2, stopped: 3 };
const KINDS = { __proto__: null, running: 'good', starting: 'info', stopping: 'info', failed: 'bad' };

/** Of missions, for their CSV. */
export const COLUMNS = [
  { name: 'missions.columns.mission', value: (each) => each.mission },
  { name: 'missions.columns.domain', value: (each) => each.domain },
  { name: 'missions.columns.template', value: (each) => each.template },
  { name: 'missions.columns.state', value: (each) => t(`missions.states.${each.status?.state ?? 'created'}`) },
  { name: 'missions.columns.since', value: (each) => dateOf(each.status?.since) },
  { name: 'missions.columns.start', value: (each) => dateOf(each.start) },
  { name: 'missions.columns.devices', value: (each) => each.status?.devices ?? each.deviceCount },
  { name: 'missions.columns.confirmed', value: (each) => each.status?.confirmed },
];

/** The missions in scope, and the chosen one, in the order of the list. */
export function missionsInScope(chosen) {
  return [...store.missions.values()].filter((each) => each.mission === chosen || store.hasInScope(each.mission, each.domain)).sort((a, b) => (a.domain === 'canary') - (b.domain === 'canary') || (ORDER[a.status?.state] ?? 2) - (ORDER[b.status?.state] ?? 2) || (a.mission < b.mission ? -1 : 1));
}

export function statePill(state) {
  return h('span.pill', { class: KINDS[state] ?? '' }, t(`missions.states.${state ?? 'created'}`));
}

export function drawList(place, chosen, choose) {
  const missions = missionsInScope(chosen);
  keepPlace(missions, place, chosen);
  const rest = others(store.missions.size - missions.length);
  redraw(place, rest && h('li', null, rest), missions.map((mission) => {
    const status = mission.status;
    const share = status?.devices ? status.confirmed / status.devices : 0;
    const filled = h('span');
    filled.style.width = `${100 * share}%`;
    return h('li', null, h('button.mission-row', { type: 'button', data: { act: `mission ${mission.mission}` }, 'aria-pressed': String(mission.mission === chosen), on: { click: () => choose(mission.mission) } },
      h('span.row', null, h('strong.cut', null, mission.mission), h('span.spacer'), statePill(status?.state)),
      h('span.row.small.muted', null, h('span.cut', null, mission.domain), h('span.spacer'), h('span.numbers', null, status && mission.running ? t('missions.confirmed', { confirmed: status.confirmed, devices: status.devices }) : '')),
      status?.devices > 0 && mission.running && h('span.bar', null, filled),
      status?.missing?.length > 0 && h('span.small.warn', null, t('missions.missing', { count: status.devices - status.confirmed })),
      status?.since && h('span.small.muted.numbers', null, t('missions.since', { age: duration(Date.now() - status.since) }))));
  }));
  return missions.length;
}

/** The chosen mission stays at its place when it is started or stopped, as it would leave the view. */
function keepPlace(missions, place, chosen) {
  const rows = [...place.querySelectorAll('.mission-row')];
  const before = rows.findIndex((row) => row.dataset.act === `mission ${chosen}`);
  const now = missions.findIndex((each) => each.mission === chosen);
  if (before >= 0 && now >= 0) {
    missions.splice(Math.min(before, missions.length - 1), 0, ...missions.splice(now, 1));
  }
}
