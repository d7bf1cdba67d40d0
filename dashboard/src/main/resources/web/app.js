/** The frame of the page: navigation, search, scope, mode (live or replay) and notices; starts the page. */
import { keepAddress } from './core/address.js';
import { api } from './core/api.js';
import { feeds, loadUser } from './core/feeds.js';
import { clock, day, duration, zone } from './core/format.js';
import { h, replace, setText } from './core/dom.js';
import { icon } from './core/icons.js';
import { nameFromTopic } from './core/identities.js';
import { amendAddress, linkTo, navigate, onRoute, route } from './core/router.js';
import { store } from './core/store.js';
import { arrange } from './alarms/order.js';
import { stopAllButton } from './cards/stop-all.js';
import './map/library.js';
import { settingsMenu } from './settings.js';
import { canSignOut, signIn, signInAgain, signOut, signedIn, readTokenFromLink } from './sign-in.js';
import { t } from './texts.js';

const PLACES = [['map', 'map'], ['missions', 'flag'], ['replays', 'history'], ['analyses', 'chart'], ['topics', 'list'], ['platform', 'server']];
const MODULES = {
  'furrow-map': './map/map.js',
  'furrow-alarms': './alarms/alarms.js',
  'furrow-cards': './cards/cards.js',
  'furrow-timeline': './timeline/timeline.js',
  'furrow-missions': './views/missions.js',
  'furrow-replays': './views/replays.js',
  'furrow-analyses': './views/analyses.js',
  'furrow-history': './views/history.js',
  'furrow-topics': './views/topics.js',
  'furrow-platform': './views/platform.js',
  'furrow-report': './views/report.js',
};
const SHOWN_FIRST = ['furrow-map', 'furrow-alarms', 'furrow-cards', 'furrow-timeline'];
/** Time for which a restored connection is reported, ms. */
const RESTORED_SHOWN = 10_000;
/** Views with the timeline below, which show a replay; all others are live, and say so. */
const WITH_TIMELINE = new Set(['map', 'replays', 'analyses', 'history']);

class App extends HTMLElement {
  connectedCallback() {
    this.view = null;
    this.announcer = h('div.visually-hidden', { role: 'status', 'aria-live': 'polite' });
    this.subscriptions = keepAddress((words) => this.announce(words)); // first, so that the parts show what it says
    this.mode = h('span.mode');
    this.leave = h('button.button.small.mode-leave', { type: 'button', hidden: true, title: t('app.toLive'), 'aria-label': t('app.toLive'), on: { click: () => store.leaveReplay() } }, icon('close', 16), h('span', null, t('app.toLive')));
    this.crumbs = h('nav.crumbs', { 'aria-label': t('app.scope') });
    this.time = h('span.now.numbers');
    this.alarms = h('a.alarm-count', { href: linkTo('map') });
    this.find = h('input', {
      type: 'search', placeholder: t('app.find'), 'aria-label': t('app.find'), autocomplete: 'off', spellcheck: 'false', value: store.filter,
      on: { input: () => this.findChanged(), keydown: (event) => this.findKey(event) },
    });
    const narrow = matchMedia('(max-width: 560px)');
    const setPlaceholder = () => (this.find.placeholder = t(narrow.matches ? 'app.findShort' : 'app.find'));
    narrow.addEventListener('change', setPlaceholder);
    setPlaceholder();
    this.rail = h('nav.rail', { 'aria-label': t('app.places') }, PLACES.map(([name, symbol]) =>
      h('a', { href: linkTo(name), 'aria-label': t(`views.${name}`), data: { view: name } }, icon(symbol, 22), h('span', { 'aria-hidden': 'true' }, t(`views.${name}`)))));
    this.viewPlace = h('div.view-place', { hidden: true, tabindex: '0', role: 'group' });
    this.notice = h('div.notice', { hidden: true });
    this.liveNote = h('p.live-note', { hidden: true }, icon('info', 16), h('span'), h('a', { href: linkTo('map') }, t('app.toReplay')));
    this.map = this.load('furrow-map');
    this.middle = h('main.middle', { id: 'content', tabindex: '-1' }, this.map, this.viewPlace);
    this.side = h('aside.side', { id: 'panel', tabindex: '-1', 'aria-label': t('app.panel') }, this.load('furrow-alarms'), this.load('furrow-cards'));
    this.timelinePlace = h('section.timeline-place', { id: 'timeline', 'aria-label': t('app.timeline') }, this.load('furrow-timeline'));

    replace(this,
      h('a.skip.button', { href: '#content', on: { click: (event) => { event.preventDefault(); this.middle.focus(); } } }, t('app.skip')),
      h('a.skip.button.skip-panel', { href: '#panel', on: { click: (event) => { event.preventDefault(); this.side.focus(); } } }, t('app.skipPanel')),
      h('a.skip.button.skip-panel', { href: '#timeline', on: { click: (event) => { event.preventDefault(); this.timelinePlace.querySelector('[role=slider]')?.focus(); } } }, t('app.skipTimeline')),
      h('header.topbar', null,
        h('a.brand', { href: linkTo('map'), 'aria-label': t('app.title') }, icon('furrow', 22), h('span', null, t('app.title'))),
        this.crumbs, this.mode, this.leave, h('span.spacer'),
        h('div.find', { role: 'search' }, icon('search', 18), this.find, h('kbd', { 'aria-hidden': 'true' }, '/')),
        this.time, this.alarms, stopAllButton(), settingsMenu()),
      h('div.notices', null, this.notice, this.liveNote), this.rail, this.middle, this.side, this.timelinePlace, this.announcer);

    this.subscriptions.push(
      onRoute(() => this.show()),
      store.on('mode', () => this.showMode()),
      store.on('clock', () => this.showTime()), store.on('connection', () => this.showConnection()),
      store.on('alarms', () => this.showAlarms()), store.on('scope', () => this.showScope()),
      store.on('filter', () => document.activeElement === this.find || (this.find.value = store.filter)),
    );
    document.addEventListener('keydown', (event) => this.key(event));
    this.show();
    this.showAlarms();
    this.showScope();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
  }

  /** Creates an element and loads its module; a module that fails does not affect others. */
  load(name) {
    const element = document.createElement(name);
    define(name).catch((error) => {
      console.error(`${MODULES[name]} could not be loaded`, error);
      replace(element, h('p.error-note', { role: 'alert' }, icon('warning'), t('app.viewFailed', { reason: error.message })));
    });
    return element;
  }

  show() {
    const { view } = route;
    const isMap = view === 'map';
    this.classList.toggle('plain', !isMap);
    this.viewPlace.hidden = isMap;
    this.viewPlace.setAttribute('aria-label', t(`views.${view}`));
    this.map.hidden = !isMap;
    this.timelinePlace.hidden = !WITH_TIMELINE.has(view);
    for (const link of this.rail.children) {
      link.dataset.view === (view === 'report' ? 'missions' : view) ? link.setAttribute('aria-current', 'page') : link.removeAttribute('aria-current');
    }
    if (view !== this.view) {
      this.view = view;
      document.title = isMap ? t('app.title') : `${t(`views.${view}`)} · ${t('app.title')}`;
      replace(this.viewPlace, isMap ? null : this.load(`furrow-${view}`)); // which may set a title of its own
      isMap || this.middle.focus({ preventScroll: true });
      this.showMode();
      this.showTime();
    }
  }

  /** Whether the view shows a replay: in a live view its clock and frame would be wrong. */
  get isRecorded() {
    return store.isReplay && WITH_TIMELINE.has(route.view);
  }

  showMode() {
    const replaying = store.isReplay;
    const recorded = this.isRecorded;
    const { mission, missions, position } = store.mode;
    this.classList.toggle('replaying', recorded);
    document.documentElement.classList.toggle('replaying', recorded);
    const name = missions?.length > 1 ? missions.join(' + ') : mission;
    replace(this.mode, recorded ? h('span.cut', null, aroundName(t('app.replayOf', { mission: name, day: day(position) }), name)) : t(store.connection.state === 'lost' ? 'app.notConnected' : 'app.live'));
    this.leave.hidden = !recorded;
    this.liveNote.hidden = recorded || !replaying;
    setText(this.liveNote.children[1], t('app.liveView', { mission: name }));
    if (this.wasReplaying !== undefined && this.wasReplaying !== replaying) {
      setText(this.announcer, replaying ? t('app.enteredReplay', { mission: name }) : t('app.enteredLive'));
      replaying || route.view !== 'map' || amendAddress({ mission: null, at: null }); // of the link to it
    }
    this.wasReplaying = replaying;
  }

  showTime() {
    const now = this.isRecorded ? store.now() : Date.now();
    const time = clock(now);
    replace(this.time, h('strong', null, time.slice(0, 5), h('span', null, time.slice(5))), h('span', null, ` ${zone(now)}`));
    this.notice.hidden || this.showConnection();
  }

  showAlarms() {
    const { open } = arrange(store.alarms.values(), Date.now());
    this.alarms.classList.toggle('open', open.length > 0);
    this.alarms.classList.toggle('critical', open.some((each) => each.severity === 'critical'));
    this.alarms.setAttribute('aria-label', t('app.alarms', { count: open.length }));
    replace(this.alarms, icon('warning', 18), h('span.numbers', { 'aria-hidden': 'true' }, open.length));
  }

  showScope() {
    const [domain, mission] = [store.scope.domain, store.scope.mission].map((name) => name && nameFromTopic(name));
    replace(this.crumbs,
      h('a.cut', { href: linkTo('missions', { tab: 'domains' }), 'aria-current': mission ? null : 'true' }, domain ?? t('app.allDomains')),
      mission && [h('span.muted', { 'aria-hidden': 'true' }, '›'), h('span.cut', { 'aria-current': 'true' }, mission)],
      domain && h('button.button.quiet.square.small', { type: 'button', 'aria-label': t('topics.showAll'), title: t('topics.showAll'), on: { click: () => store.setScope({}) } }, icon('close', 16)));
    this.classList.toggle('scoped', Boolean(domain));
  }

  showConnection() {
    const { state, since, lastRecord, reason, lostSince, missed } = store.connection;
    const lost = state === 'lost';
    const restored = state === 'open' && lostSince !== null && Date.now() - since < RESTORED_SHOWN;
    this.classList.toggle('lost', lost);
    this.notice.hidden = !lost && !restored;
    if (lost !== this.wasLost) {
      this.wasLost = lost;
      this.showMode();
      lost && this.announce(t('app.notConnected'));
    }
    if (restored) {
      const words = [t('app.away', { from: clock(lostSince), to: clock(since) }), missed > 0 && t('app.gap', { count: missed })].filter(Boolean).join(' ');
      this.notice.textContent === words || replace(this.notice, icon('info'), words);
    } else if (lost) {
      const lostFor = duration(Date.now() - since);
      replace(this.notice, icon('warning'),
        lastRecord ? t('app.lost', { duration: lostFor, time: clock(lastRecord) }) : t('app.lostNever', { duration: lostFor, reason: reason ?? '' }));
    }
  }

  announce(text) { setText(this.announcer, text); }

  findChanged() {
    clearTimeout(this.finding);
    this.finding = setTimeout(() => store.setFilter(this.find.value), 120);
    if (route.view !== 'map' && this.find.value) {
      navigate('map');
    }
  }

  findKey({ key }) {
    if (key === 'Escape') {
      this.clearFind();
    } else if (key === 'Enter' && this.find.value.trim()) {
      clearTimeout(this.finding);
      store.setFilter(this.find.value);
      this.map.find?.();
    }
  }

  clearFind() {
    this.find.value = '';
    store.setFilter('');
    this.find.blur();
  }

  key(event) {
    const typing = event.target.closest?.('input, textarea, select, [contenteditable]');
    if (event.key === '/' && !typing && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      this.find.focus();
    }
  }
}

/** Loads the module of an element. @returns {Promise} */
function define(name) {
  return customElements.get(name) ? Promise.resolve() : import(MODULES[name]);
}

/** Splits words around a name: a narrow window shows the name alone, since icon and color indicate a replay. */
function aroundName(words, name) {
  const at = words.indexOf(name);
  return [h('span.mode-more', null, words.slice(0, at)), name, h('span.mode-more', null, words.slice(at + name.length))];
}

customElements.define('furrow-app', App);

// --- start -----------------------------------------------------------------------------------------------------------

const RETRY_MILLIS = 2_000;
const MAX_RETRY_MILLIS = 30_000;
const opening = document.querySelector('.opening');
let failures = 0;
let retrying = null;

async function start() {
  clearTimeout(retrying);
  const user = loadUser();
  feeds.live(); // the server reads the devices' states while the page is built
  try {
    await user;
  } catch (error) {
    feeds.close();
    return error.status === 401 ? signIn(start) : unreachable(error);
  }
  signedIn();
  await feeds.start();
  replace(document.body, document.createElement('furrow-app'));
  api.onSignedOut(signInAgain);
}

/** Shows the reason and retries with increasing delays; the frame of index.html stays visible. */
function unreachable(error) {
  failures++;
  const words = h('div.opening-words', null, h('div.stack', null,
    h('p.error-note', { role: 'alert' }, icon('warning'), t('opening.away', { reason: error.message })),
    h('p.small.muted', null, t('opening.again')),
    h('div.row', null,
      h('button.button.primary', { type: 'button', on: { click: start } }, t('opening.retry')),
      error.status === 403 && canSignOut() && h('button.button', { type: 'button', on: { click: signOut } }, t('app.signOut')))));
  const shown = document.querySelector('.opening-words');
  shown?.textContent === words.textContent || replace(opening.querySelector('.middle'), words);
  opening.isConnected || replace(document.body, opening);
  retrying = setTimeout(start, Math.min(MAX_RETRY_MILLIS, RETRY_MILLIS * 2 ** (failures - 1)));
}

readTokenFromLink();
start();
SHOWN_FIRST.forEach((name) => define(name).catch(() => {})); // after the requests of the start: browsers open few connections at a time
