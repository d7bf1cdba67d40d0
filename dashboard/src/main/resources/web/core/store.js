/** The state of the page. Feeds write it, elements subscribe to its changes. */
import { Coverages } from './coverage.js';
import { stateOf } from './entity.js';
import { Identities, isSameName, isSameType, scope } from './identities.js';
import { Reducers } from './reducers.js';

/** Time for which an encounter that ended is shown, in the page's time, ms. */
const ENDED_SHOWN = 10_000;
/** Time for which the worked area of a mission is shown after its last report, in the page's time, ms. */
export const COVERAGE_SHOWN = 12 * 3_600_000;

class Store extends Reducers(Object) {
  constructor() {
    super();
    this.handlers = new Map();
    this.changed = new Map();
    this.domains = new Map();
    this.missions = new Map();
    this.devices = new Map();
    this.recordings = new Map();
    this.replays = new Map();
    this.alarms = new Map();
    this.topics = new Map();
    this.me = { user: null, role: null };
    this.config = { analytics: [] };
    this.connection = { state: 'connecting', since: Date.now(), lastRecord: null, lostSince: null, missed: 0 };
    this.mode = { kind: 'live' };
    this.scope = { domain: null, mission: null };
    this.selection = null;
    this.hovered = null;
    this.cursor = null;
    this.filter = '';
    this.primed = false;
    /** Whether the reports from before the page was opened were read. */
    this.pastLoaded = false;
    this.fields = new Map();
    this.fieldVersions = new Map();
    /** Of each list: whether it is being read, and why it could not be. */
    this.lists = Object.fromEntries(['domains', 'missions', 'devices', 'recordings', 'fields', 'replays', 'alarms'].map((name) => [name, { loading: true, error: null }]));
    this.clearShown();
    // a hidden tab does not draw the frame that was scheduled
    document.addEventListener('visibilitychange', () => document.hidden && this.scheduled && setTimeout(() => this.flush(), 1000));
  }

  /** Clears the state that belongs to one timeline: when a replay begins, seeks or ends. */
  clearShown() {
    this.entities = new Map();
    this.identities = new Identities();
    this.encounters = new Map();
    this.suspects = new Map();
    this.images = new Map();
    this.averages = new Map();
    this.coverages = new Coverages();
    this.all = true;
    ['entities', 'encounters', 'suspects', 'images', 'fields', 'coverages'].forEach((name) => this.notify(name));
  }

  // --- subscriptions -----------------------------------------------------------------------------------------------

  /** Adds a handler, which is called at most once per animation frame. @returns {function()} removes it */
  on(name, handler) {
    if (!this.handlers.has(name)) {
      this.handlers.set(name, new Set());
    }
    this.handlers.get(name).add(handler);
    return () => this.handlers.get(name).delete(handler);
  }

  /** Schedules the handlers of a change. @param {string=} id of the entity, for `entities` */
  notify(name, id) {
    if (!this.changed.has(name)) {
      this.changed.set(name, new Set());
    }
    id !== undefined && this.changed.get(name).add(id);
    if (!this.scheduled) {
      this.scheduled = true;
      // a hidden tab draws no frames, but still has to release memory
      document.hidden ? setTimeout(() => this.flush(), 1000) : requestAnimationFrame(() => this.flush());
    }
  }

  flush() {
    this.scheduled = false;
    const changed = this.changed;
    const all = this.all;
    this.changed = new Map();
    this.all = false;
    for (const [name, ids] of changed) {
      for (const handler of this.handlers.get(name) ?? []) {
        try {
          handler(ids, all);
        } catch (error) {
          console.error(`handler of ${name} failed`, error);
        }
      }
    }
  }

  /** @param {string} name of a list @param {{loading: boolean, error: Error|null}} state */
  setList(name, state) {
    this.lists[name] = state;
    this.notify(name);
  }

  // --- time --------------------------------------------------------------------------------------------------------

  /** The page's time, epoch ms: now, or the position of the replay. */
  now() {
    if (this.mode.kind === 'live') {
      return Date.now();
    }
    const { position, at, speed, state, to } = this.mode;
    const moved = state === 'running' && typeof speed === 'number' ? (Date.now() - at) * speed : 0;
    return Math.min(to ?? Infinity, (position ?? Date.now()) + Math.max(0, Math.min(moved, 2_000 * (speed || 1))));
  }

  stateOf(entity) {
    const device = this.deviceOf(entity);
    const state = stateOf(entity, this.now(), this.isReplay ? entity.time : entity.heard, device?.period);
    // its mission was stopped; a device that reports nevertheless is not off
    return state === 'stale' && !this.isReplay && device?.wanted === 'stopped' ? 'off' : state;
  }

  /** The device of an entity in the REST API. @returns {Object|undefined} */
  deviceOf({ type, identity }) {
    const key = deviceKey(identity);
    const first = this.devices.get(identity.id);
    const device = first && deviceKey(first) === key ? first : this.devices.get(key);
    return device?.type && !isSameType(device.type, type) ? undefined : device;
  }

  /** The entity of a device of the REST API. @returns {import('./entity.js').Entity|undefined} */
  entityOf(device) {
    return this.entities.get(this.identities.keyOfDevice(device));
  }

  /** Whether a replay is shown. */
  get isReplay() {
    return this.mode.kind === 'replay';
  }

  setMode(mode) {
    const changed = mode.kind !== this.mode.kind || mode.replay !== this.mode.replay;
    this.mode = mode;
    if (changed) {
      this.primed = false;
      this.clearShown();
    }
    this.notify('mode');
    this.notify('clock');
  }

  /** Updates the position and state of the replay. @param {Object} progress */
  setProgress(progress) {
    Object.assign(this.mode, progress);
    this.notify('mode');
    this.notify('clock');
  }

  /** Shows a replay instead of live data. @param {{replay: string, mission: string, topic: string}} replay of `/api/replays` */
  enterReplay(replay) {
    this.feeds?.enterReplay(replay);
  }

  leaveReplay() {
    this.feeds?.leaveReplay();
  }

  /** Updates states that depend on the time. */
  tick() {
    for (const entity of this.entities.values()) {
      const state = this.stateOf(entity);
      if (state !== entity.state) {
        entity.state = state;
        this.notify('entities', entity.id);
      }
    }
    this.fieldVersions.forEach((versions, id) => this.showField(id));
    const now = this.now();
    for (const [pair, encounter] of this.encounters) {
      const timeout = encounter.phase === 'ended' || encounter.phase === 'crossed' ? ENDED_SHOWN : 60_000;
      if (now - encounter.time > timeout) {
        this.encounters.delete(pair);
        this.notify('encounters');
      }
    }
    this.notify('clock');
  }

  /** Whether all alarms were read. */
  get alarmsLoaded() {
    return !this.lists.alarms.loading;
  }

  // --- selection, filter and scope ---------------------------------------------------------------------------------

  /** Whether an entity belongs to the chosen domain and mission, if any. */
  inScope(entity) {
    const { domain, mission } = this.scope;
    return (domain === null || isSameName(entity.domain, domain)) && (mission === null || isSameName(entity.mission, mission));
  }

  /** Whether something that is about these entities is shown: one of them is in the scope, or none is known. */
  isAboutScope(entities) {
    const known = entities.filter(Boolean);
    return this.scope.domain === null || known.length === 0 || known.some((each) => this.inScope(each));
  }

  /** Whether something of a mission, and of a domain if that is known, is shown. */
  hasInScope(mission, domain) {
    const { scope } = this;
    return scope.domain === null || ((scope.mission === null || isSameName(mission, scope.mission)) && isSameName(domain ?? scope.domain, scope.domain));
  }

  /** What was worked in the chosen domain and mission, the newest last. */
  coveragesInScope() {
    const since = this.now() - COVERAGE_SHOWN;
    return this.coverages.sorted.filter((each) => each.time > since && this.hasInScope(each.mission, each.domain ?? this.missions.get(each.mission)?.domain));
  }

  /** The fields of a domain: those that name it, and those that it lists. */
  fieldsOf(domain) {
    const listed = this.domains.get(domain)?.fields ?? [];
    return [...this.fields.values()].filter((each) => each.properties.Domain === domain || listed.includes(each.id));
  }

  /** The fields of the chosen domain and those of none, or all. */
  fieldsInScope() {
    const { domain } = this.scope;
    const fields = [...this.fields.values()];
    const own = domain === null ? fields : this.fieldsOf(domain);
    return domain === null ? fields : fields.filter((each) => own.includes(each) || !each.properties.Domain);
  }

  /** Whether the name, id, type or mission contains the search text. */
  matches(entity) {
    return this.isFound(entity.name, entity.identity.id, entity.type, entity.mission ?? '');
  }

  /** Whether one of the texts contains the search text. */
  isFound(...texts) {
    const needle = this.filter.trim().toLowerCase();
    return texts.some((each) => each.toLowerCase().includes(needle));
  }

  select(id, { reveal = false } = {}) {
    this.selection = id;
    this.reveal = reveal;
    this.notify('selection');
  }

  setHovered(id) {
    if (this.hovered !== id) {
      this.hovered = id;
      this.notify('hovered');
    }
  }

  setCursor(time) {
    this.cursor = time;
    this.notify('cursor');
  }

  setFilter(text) {
    this.filter = text;
    this.notify('filter');
  }

  setScope(scope) {
    this.scope = { domain: scope.domain ?? null, mission: scope.mission ?? null };
    this.all = true;
    this.notify('scope');
    this.notify('entities');
  }

  /** Whether the user may perform an action. @param {'operate'|'administer'} action */
  may(action) {
    return this.me.role === 'admin' || (action === 'operate' && this.me.role === 'operator');
  }
}

/** The store's key of a device of the REST API if another device has its id. @param {{id: string, service: string=, servicePath: string=}} device */
export function deviceKey({ id, service, servicePath }) {
  const { service: tenant, servicePath: path } = scope(service, servicePath);
  return [tenant, path, id].join('|');
}

/** What replays with one clock cover together, as far as it is known: a mission may still be recorded. @returns {{from: number|undefined, to: number|undefined}} */
export function spanOf(replays) {
  const known = replays.map((each) => each?.status?.progress).filter((each) => each?.to > 0); // 0 until it has begun
  return known.length === 0 ? {} : { from: Math.min(...known.map((each) => each.from)), to: Math.max(...known.map((each) => Math.max(each.to, each.position ?? 0))) };
}

export const store = new Store();
