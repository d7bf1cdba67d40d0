/** All that the page shows. Feeds write it, elements listen to it. */
import { stateOf } from './entity.js';
import { Identities, scope } from './identities.js';
import { Reducers } from './reducers.js';

/** How long an encounter that ended stays to be seen, ms of what is shown. */
const ENDED_SHOWN = 10_000;

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
    this.alarmsLoaded = false;
    this.topics = new Map();
    this.me = { user: null, role: null };
    this.config = {};
    this.connection = { state: 'connecting', since: Date.now(), lastRecord: null, awayFrom: null, missed: 0 };
    this.mode = { kind: 'live' };
    this.scope = { domain: null, mission: null };
    this.selection = null;
    this.hovered = null;
    this.cursor = null;
    this.filter = '';
    this.primed = false;
    /** What was reported before the page was opened has been read. */
    this.pastLoaded = false;
    this.fields = new Map();
    this.fieldVersions = new Map();
    this.clearShown();
    // the frame that was waited for is not drawn in a hidden tab
    document.addEventListener('visibilitychange', () => document.hidden && this.scheduled && setTimeout(() => this.flush(), 1000));
  }

  /** What belongs to one run of time: all goes when a replay begins, jumps or ends. */
  clearShown() {
    this.entities = new Map();
    this.identities = new Identities();
    this.encounters = new Map();
    this.suspects = new Map();
    this.images = new Map();
    this.averages = new Map();
    this.all = true;
    ['entities', 'encounters', 'suspects', 'images', 'fields'].forEach((name) => this.notify(name));
  }

  // --- who listens -------------------------------------------------------------------------------------------------

  /** @returns {function()} ends it. Handlers are called once per name and animation frame at most. */
  on(name, handler) {
    if (!this.handlers.has(name)) {
      this.handlers.set(name, new Set());
    }
    this.handlers.get(name).add(handler);
    return () => this.handlers.get(name).delete(handler);
  }

  /** Says that something changed. @param {string=} id of the entity, for `entities` */
  notify(name, id) {
    if (!this.changed.has(name)) {
      this.changed.set(name, new Set());
    }
    id !== undefined && this.changed.get(name).add(id);
    if (!this.scheduled) {
      this.scheduled = true;
      // a hidden tab draws no frames, but has to let go of what it remembers
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

  // --- time --------------------------------------------------------------------------------------------------------

  /** Of what is shown, epoch ms: the clock, or where the replay is. */
  now() {
    if (this.mode.kind === 'live') {
      return Date.now();
    }
    const { position, at, speed, state, to } = this.mode;
    const moved = state === 'running' && typeof speed === 'number' ? (Date.now() - at) * speed : 0;
    return Math.min(to ?? Infinity, (position ?? Date.now()) + Math.max(0, Math.min(moved, 2_000 * (speed || 1))));
  }

  stateOf(entity) {
    return stateOf(entity, this.now(), this.deviceOf(entity)?.period);
  }

  /** What the REST API lists of an entity: robots of FIROS write their type in upper case. @returns {Object|undefined} */
  deviceOf({ type, identity }) {
    const key = deviceKey(identity);
    const first = this.devices.get(identity.id);
    const device = first && deviceKey(first) === key ? first : this.devices.get(key);
    return device?.type && device.type.toLowerCase() !== type.toLowerCase() ? undefined : device;
  }

  /** The entity of a device that the REST API lists. @returns {import('./entity.js').Entity|undefined} */
  entityOf(device) {
    return this.entities.get(this.identities.keyOf(device.id, scope(device.service, device.servicePath)));
  }

  /** Whether what is shown stands for now, or was recorded. */
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

  /** Where a replay is. @param {Object} progress */
  setProgress(progress) {
    Object.assign(this.mode, progress);
    this.notify('mode');
    this.notify('clock');
  }

  /** Shows a replay instead of what is live. @param {{replay: string, mission: string, topic: string}} replay of `/api/replays` */
  enterReplay(replay) {
    this.feeds?.enterReplay(replay);
  }

  leaveReplay() {
    this.feeds?.leaveReplay();
  }

  /** States that change by time alone. */
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

  // --- what is looked at -------------------------------------------------------------------------------------------

  /** Entities of the chosen domain and mission; what belongs to none is always in it. */
  inScope(entity) {
    const { domain, mission } = this.scope;
    return (domain === null || entity.domain === domain) && (mission === null || entity.mission === mission);
  }

  /** Whether a name, type or attribute holds what is searched for. */
  matches(entity) {
    return this.isFound(entity.name, entity.identity.id, entity.type, entity.mission ?? '');
  }

  /** Whether one of the texts holds what is searched for. */
  isFound(...texts) {
    const wanted = this.filter.trim().toLowerCase();
    return texts.some((each) => each.toLowerCase().includes(wanted));
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

  /** @param {'operate'|'administer'} what */
  may(what) {
    return this.me.role === 'admin' || (what === 'operate' && this.me.role === 'operator');
  }
}

/** Of a device as the REST API lists it, by which the store has it where another one has its id. @param {{id: string, service: string=, servicePath: string=}} device */
export function deviceKey({ id, service, servicePath }) {
  const of = scope(service, servicePath);
  return [of.service, of.servicePath, id].join('|');
}

/** Where a replay ends, as far as that is known: a mission that is recorded meanwhile goes on. @returns {number|undefined} */
export function endOf({ position, to }) {
  return to > 0 ? Math.max(to, position ?? 0) : to;
}

export const store = new Store();
