/** Shows missions with their devices, domains with their fields, and the audit. */
import { csvButton } from '../core/csv.js';
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { navigate, onRoute, route } from '../core/router.js';
import { resource } from '../core/resource.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { auditView } from './missions/audit.js';
import { createMission } from './missions/create.js';
import { MissionDetail } from './missions/detail.js';
import { Domains } from './missions/domains.js';
import { COLUMNS, drawList, missionsInScope } from './missions/list.js';
import { redraw } from '../core/redraw.js';

/** Below this width the mission is shown below the list. */
const NARROW = matchMedia('(max-width: 1100px)');
const TABS = ['missions', 'domains', 'audit'];

class FurrowMissions extends HTMLElement {
  connectedCallback() {
    this.tabs = h('div.tabs', { role: 'tablist', 'aria-label': t('views.missions') }, TABS.map((name) => h('button.tab', {
      type: 'button', role: 'tab', id: `tab-${name}`, 'aria-controls': 'missions-panel', on: { click: () => navigate('missions', { tab: name === 'missions' ? null : name }), keydown: (event) => this.tabKey(event) },
    }, t(`missions.tabs.${name}`))));
    this.create = h('button.button.primary', { type: 'button', on: { click: () => this.newMission() } }, icon('plus', 16), t('missions.new'));
    this.csv = csvButton(t('views.missions'), 'missions', COLUMNS, () => missionsInScope(this.chosen));
    this.viewer = h('p.viewer-note', { hidden: true }, icon('info', 16), t('missions.viewer'));
    this.panel = h('div', { id: 'missions-panel', role: 'tabpanel' });
    replace(this, h('div.view', null, h('header', null, h('h1', null, t('views.missions')), this.tabs, h('span.spacer'), this.csv, this.create), this.viewer, this.panel));
    this.subscriptions = [onRoute(() => this.show()), store.on('missions', () => this.drawList()), store.on('scope', () => this.drawList()), store.on('me', () => this.allow())];
    this.answer = resource('/api/missions', { interval: 10_000 });
    this.subscriptions.push(this.answer.on(() => this.applyAnswer()));
    this.ticking = setInterval(() => document.hidden || this.drawList(), 5_000);
    this.show();
    this.allow();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    clearInterval(this.ticking);
    this.answer.close();
    this.content?.close();
  }

  allow() {
    this.create.hidden = !store.may('operate');
    this.viewer.hidden = !store.me.role || store.may('operate');
  }

  show() {
    const { tab = 'missions', mission, device } = route.query;
    const view = `${tab} ${mission} ${device}`;
    if (route.view !== 'missions' || view === this.shown) {
      return;
    }
    this.shown = view;
    this.content?.close();
    this.content = null;
    for (const button of this.tabs.children) {
      const chosen = button.id === `tab-${tab}`;
      button.setAttribute('aria-selected', String(chosen));
      button.tabIndex = chosen ? 0 : -1;
    }
    this.panel.setAttribute('aria-labelledby', `tab-${tab}`);
    this.csv.hidden = tab !== 'missions';
    if (tab === 'domains') {
      this.content = new Domains();
      replace(this.panel, this.content.element);
    } else if (tab === 'audit') {
      this.content = auditView({ mission, device });
      redraw(this.panel, this.content.element);
    } else {
      this.showMissions(mission);
    }
  }

  showMissions(mission) {
    this.list = h('ul.stack.mission-list');
    this.place = h('div');
    this.empty = h('div.empty', { hidden: true }, h('h2', null, t('missions.none')), h('p', null, t('missions.noneHint')),
      store.may('operate') && h('button.button.primary', { type: 'button', on: { click: () => this.newMission() } }, t('missions.new')));
    replace(this.panel, this.empty, h('div.mission-columns', null, this.list, this.place));
    const missions = [...store.missions.values()].filter((each) => store.hasInScope(each.mission, each.domain));
    const chosen = mission ?? (missions.find((each) => each.running && each.domain !== 'canary') ?? missions[0])?.mission;
    if (chosen) {
      this.content = new MissionDetail(chosen, () => navigate('missions'));
      replace(this.place, this.content.element);
    }
    this.chosen = chosen;
    this.drawList();
    if (mission && NARROW.matches) {
      this.place.scrollIntoView({ block: 'start' });
    }
  }

  /** Applies the list of missions, which distinguishes an empty list from one that is not loaded. */
  applyAnswer() {
    if (store.missions.size === 0 && this.answer.value?.length > 0) {
      store.missions = new Map(this.answer.value.map((each) => [each.mission, each]));
      store.notify('missions');
    }
    this.drawList();
  }

  drawList() {
    if (this.list?.isConnected) {
      const count = drawList(this.list, this.chosen, (name) => navigate('missions', { mission: name }));
      const { loading, error } = this.answer;
      const isEmpty = store.missions.size === 0;
      this.empty.hidden = !isEmpty || loading || Boolean(error);
      if (isEmpty) {
        redraw(this.list, loading && [0, 1, 2].map(() => h('li.skeleton.mission-skeleton', null, '…')), error && h('li.error-note', null, icon('warning'), error.message));
      }
      if (!this.chosen && count > 0) {
        this.shown = null;
        this.show();
      }
    }
  }

  async newMission() {
    const dialog = await createMission();
    dialog.addEventListener('created', (event) => navigate('missions', { mission: event.detail }));
  }

  tabKey(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step) {
      const next = this.tabs.children[(TABS.indexOf(event.target.id.slice(4)) + step + TABS.length) % TABS.length];
      next.focus();
      next.click();
    }
  }
}

customElements.define('furrow-missions', FurrowMissions);
