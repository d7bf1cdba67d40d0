/** Feeds the store from topics: live, or from a replay. */
import { api } from './api.js';
import { followCoverage } from './coverage.js';
import { exists } from './existing.js';
import { resource } from './resource.js';
import { COVERAGE_SHOWN, deviceKey, spanOf, store } from './store.js';
import { streams } from './stream.js';
import { t } from '../texts.js';

const LISTS = {
  domains: { path: '/api/domains', key: (each) => each.domain, topics: ['service.domains'] },
  missions: { path: '/api/missions', key: (each) => each.mission, topics: ['service.missions', 'service.missions.status'] },
  devices: { path: '/api/devices', key: (each, existing) => (existing.has(each.id) ? deviceKey(each) : each.id), topics: ['service.devices'] },
  recordings: { path: '/api/recordings', key: (each) => each.mission, topics: ['service.recordings'] },
};
/** Interval at which a replay reads newer images. */
const IMAGES_MILLIS = 5_000;
/** How far trails and series reach back when the page is opened, and the maximum number of reports. */
const PAST_MILLIS = 300_000;
const PAST_REPORTS = 3_000;
/** Time after the initial state until they are requested, in which the devices are drawn, ms. */
const PAST_DELAY = 500;
const OVER = new Set(['ended', 'stopped', 'failed']);

/** Maximum delay of the entities' initial state: an interval between checkpoints of ingest, and a margin. */
const MAX_STATE_DELAY = 60_000;

/** Time for which the page waits for the socket of the devices' states, ms: building the page first delays it by more than a busy server takes. */
const REQUEST_TIMEOUT = 1_000;

class Feeds {
  /** Subscribes to all else once the devices' states are requested. @returns {Promise} */
  async start() {
    store.feeds = this;
    await Promise.race([this.shown[0].requested, new Promise((resolve) => setTimeout(resolve, REQUEST_TIMEOUT))]);
    this.shared = [
      this.feed('service.alarms', 'all', (record) => store.applyAlarm(record), { list: 'alarms', whileHidden: mayNotify }),
      this.feed('service.fields', 'all', (record) => store.applyField(record), { list: 'fields' }),
      this.feed('service.replays', 'all', (record) => this.applyReplay(record), { list: 'replays' }),
      this.feed('service.replays.status', 'latest', (record) => this.applyStatus(record)),
    ];
    Object.entries(LISTS).forEach(([name, list]) => this.syncList(name, list));
    setInterval(() => document.hidden || store.tick(), 1000);
    setInterval(() => document.hidden || this.readImages(), IMAGES_MILLIS);
  }

  /**
   * Subscribes to a topic whose records `apply` processes, with statistics in `store.topics`. `apply` returns keys if they are not the key of the
   * record; `list` names the list of the store that they form. An initial state has no deletions: `forget` is called for each key that an earlier connection had and the initial state lacks, with the
   * time of its newest record, and the time when the key was last received.
   */
  feed(topic, mode, apply, { main = false, forget = (key) => apply({ key, headers: {}, value: null }), list = null, createdLater = false, whileHidden } = {}) {
    const previous = new Map();
    let [keys, newest] = [new Map(), -Infinity];
    const figures = { name: topic, count: 0, rate: 0, gap: 0, state: 'connecting', since: Date.now() };
    store.topics.set(topic, figures);
    const stream = streams.subscribe(topic, { mode, prime: true, createdLater, whileHidden }, {
      records: (records, merged) => {
        for (const record of records) {
          const changedKeys = apply(record) ?? [record.key];
          record.kind === 'event' ? figures.count++ : (newest = Math.max(newest, record.time));
          changedKeys.forEach((key) => (record.value === null && !record.cut ? keys.delete(key) : keys.set(key, Date.now())));
        }
        figures.count += merged;
        figures.last = Date.now();
        main && (store.connection.lastRecord = Date.now());
        store.notify('topics');
      },
      primed: () => {
        previous.forEach((receivedAt, key) => keys.has(key) || forget(key, newest, receivedAt));
        previous.clear();
        list && store.setList(list, { loading: false, error: null });
        if (main) {
          store.primed = true;
          store.notify('entities');
          setTimeout(() => store.isReplay || this.readPast(), PAST_DELAY);
        }
      },
      gap: (missed) => {
        figures.gap += missed;
        store.connection.missed += missed;
        store.notify('connection');
      },
      state: (state, reason) => {
        if (state === 'open') {
          keys.forEach((receivedAt, key) => previous.set(key, receivedAt));
          [keys, newest] = [new Map(), -Infinity];
        }
        Object.assign(figures, { state, reason });
        list && isFailed(state) && store.setList(list, { ...store.lists[list], error: new Error(reason ?? t('errors.noAnswer')) });
        store.notify('topics');
        main && this.connection(state, reason);
      },
    });
    return { requested: stream.requested, close: () => { stream.close(); store.topics.delete(topic); store.notify('topics'); } };
  }

  connection(state, reason) {
    const next = state === 'open' || state === 'paused' ? 'open' : state === 'connecting' && store.connection.state !== 'lost' ? 'connecting' : 'lost';
    if (next !== store.connection.state) {
      const { state: previous, since, lastRecord, missed } = store.connection;
      const isRestored = state === 'open' && previous === 'lost' && lastRecord !== null;
      Object.assign(store.connection, { state: next, since: Date.now(), lostSince: isRestored ? since : null, missed: next === 'lost' ? 0 : missed });
    }
    store.connection.reason = reason;
    store.notify('connection');
  }

  /** Keeps a list of the REST API up to date in the store. */
  syncList(name, { path, key, topics }) {
    const list = resource(path, { topics });
    list.on(() => {
      if (!list.error) {
        store[name] = new Map();
        (list.value ?? []).forEach((each) => store[name].set(key(each, store[name]), each));
        name === 'devices' && store.entities.forEach((entity, key) => store.applyHealth(entity) && store.notify('entities', key));
      }
      store.setList(name, { loading: false, error: list.error });
    });
  }

  /** Shows what devices report now. */
  live() {
    this.close();
    store.setMode({ kind: 'live' });
    this.shown = [
      this.feed('data.raw', 'latest', (record) => store.applyEntity(record), {
        main: true,
        // a recent record that is newer than the initial state is not part of it yet
        forget: (key, newest, receivedAt) => (store.entities.get(key)?.time <= newest || Date.now() - receivedAt > MAX_STATE_DELAY) && store.forgetEntity(key),
      }),
      this.feed('data.collision', 'all', (record) => store.applyEncounter(record), { createdLater: true }),
      this.feed('data.temperature', 'all', (record) => store.applyTemperature(record), { createdLater: true }),
      this.feed('data.images', 'latest', (record) => store.applyImage(record), { createdLater: true }),
      followCoverage('data.coverage', Date.now() - COVERAGE_SHOWN, (record) => store.applyCoverage(record)),
    ];
  }

  /** Closes the streams of what is shown. */
  close() {
    this.shown?.forEach((each) => each.close());
  }

  /** Reads recent reports, once: after a lost connection trails and series continue where they ended. */
  async readPast() {
    if (this.pastRead) {
      return;
    }
    this.pastRead = true;
    try {
      const { records } = await api.get(`/api/history/data.raw?${new URLSearchParams({ from: Date.now() - PAST_MILLIS, limit: PAST_REPORTS })}`);
      store.isReplay || store.applyPast(records);
    } catch {
      // trails and series begin now
    }
    store.pastLoaded = true;
  }

  applyReplay(record) {
    const existing = store.replays.get(record.key);
    if (record.value === null) {
      existing && store.replays.set(record.key, { ...existing, gone: true });
    } else {
      store.replays.set(record.key, { ...record.value, status: existing?.status });
    }
    store.notify('replays');
    this.follow(record.key);
  }

  applyStatus(record) {
    const existing = store.replays.get(record.key) ?? { replay: record.key };
    if (record.value === null && store.mode.replay === record.key) {
      store.replays.set(record.key, { ...existing, gone: true });
    } else if (record.value === null) {
      store.replays.delete(record.key);
    } else {
      store.replays.set(record.key, { ...existing, status: { ...record.value, time: record.time } });
    }
    store.notify('replays');
    this.follow(record.key);
  }

  /** Applies the state of a replay if it is the one that is shown, or of its group. */
  follow(name) {
    const mode = store.mode;
    const isMember = mode.group && store.replays.get(name)?.group === mode.group;
    if (mode.kind !== 'replay' || (mode.replay !== name && !isMember)) {
      return;
    }
    const replay = store.replays.get(mode.replay);
    const status = replay?.status;
    const progress = status?.progress ?? {};
    const { from, to } = spanOf(this.membersOf(replay?.group, replay));
    store.setProgress({
      state: status?.state ?? 'starting', reason: status?.reason, over: OVER.has(status?.state),
      speed: replay?.speed ?? mode.speed, range: replay?.range ?? null, group: replay?.group ?? mode.group,
      // 0 until it has begun
      position: progress.position || mode.position, from: from ?? mode.from, to: to ?? mode.to,
      at: status?.time ?? Date.now(), progress, waiting: progress.waiting,
    });
  }

  /** The replays of a group, which have one clock. */
  membersOf(group, alone) {
    return group ? [...store.replays.values()].filter((each) => each.group === group) : [alone];
  }

  /** @param {{replay: string, mission: string, topic: string, group: string=}} replay */
  enterReplay(replay) {
    const topic = replay.topic ?? store.replays.get(replay.replay)?.topic;
    const existing = store.replays.get(replay.replay);
    const mission = replay.mission ?? existing?.mission;
    if (!topic || !mission) {
      return; // only its status is known yet; it is entered once the rest is
    }
    const group = replay.group ?? existing?.group;
    const members = this.membersOf(group, { ...existing, ...replay, topic });
    this.shown?.forEach((each) => each.close());
    const recordings = members.map((each) => store.recordings.get(each.mission)).filter(Boolean);
    const [first, last] = recordings.length ? [Math.min(...recordings.map((each) => each.first)), Math.max(...recordings.map((each) => each.last))] : [];
    store.setMode({
      kind: 'replay', replay: replay.replay, group, mission, topic, missions: members.map((each) => each.mission),
      results: Object.fromEntries(store.config.analytics.map((job) => [job, members.map((each) => ({ topic: `${each.topic}.${job}`, mission: each.mission }))])),
      state: 'starting', speed: existing?.speed ?? 1, position: first, from: first, to: last, at: Date.now(), epoch: -1,
    });
    this.epochs = new Map();
    this.shown = members.flatMap((each, index) => [
      this.feed(each.topic, 'latest', (record) => this.applyReplayed(record), { main: index === 0, forget: (key) => store.forgetEntity(key) }),
      ...['collision', 'temperature'].filter((job) => each.analytics?.includes(job)).map((job) => this.feed(`${each.topic}.${job}`, 'all', (record) => this.applyResult(record, each.topic,
        () => (job === 'collision' ? store.applyEncounter(record) : store.applyTemperature(record, each.mission))), { createdLater: true })),
      ...(each.analytics?.includes('coverage') ? [followCoverage(`${each.topic}.coverage`, 0, (record) => this.applyResult(record, each.topic, () => store.applyCoverage(record)))] : []),
    ]);
    this.follow(replay.replay);
    this.readImages();
  }

  /** Applies a record of a replay. A seek begins a new epoch, and clears what is shown of the previous one. */
  applyReplayed(record) {
    const epoch = Number(record.headers['replay-epoch'] ?? 0);
    const current = this.epochs.get(record.topic) ?? -1;
    if (epoch < current) {
      return [];
    }
    if (epoch > current) {
      this.epochs.set(record.topic, epoch);
      if (current >= 0 && epoch > store.mode.epoch) {
        store.clearShown();
        this.readImages();
      }
      store.mode.epoch = Math.max(store.mode.epoch, epoch);
    }
    if (record.headers['replay-kind'] === 'end') {
      return [];
    }
    return store.applyEntity(record.headers['replay-kind'] === 'prime' ? { ...record, kind: 'prime' } : record);
  }

  applyResult(record, topic, apply) {
    const epoch = Number(record.headers['replay-epoch'] ?? 0);
    if (epoch >= (this.epochs.get(topic) ?? 0)) {
      apply();
    }
  }

  /** Reads the images that are the newest at the position of a replay; images are stored and not replayed. */
  async readImages() {
    const { kind, from, replay } = store.mode;
    if (kind !== 'replay' || !from || this.readingImages) {
      return;
    }
    this.readingImages = true;
    try {
      const range = new URLSearchParams({ from, to: Math.ceil(store.now()) + 1, newest: 'entity' });
      const found = await exists('data.images') ? await api.get(`/api/history/data.images?${range}`) : { records: [] };
      if (store.mode.replay === replay) {
        found.records.forEach((record) => store.applyImage(record));
      }
    } catch {
      // the cards show that there is no image
    } finally {
      this.readingImages = false;
    }
  }

  leaveReplay() {
    if (store.mode.kind === 'replay') {
      this.live();
    }
  }
}

/** Whether a stream has no connection; it is paused while the page is hidden. */
function isFailed(state) {
  return state === 'waiting' || state === 'refused';
}

/** Whether alarms must be received while the page is hidden, for notifications of the browser. */
function mayNotify() {
  return 'Notification' in window && Notification.permission === 'granted';
}

export const feeds = new Feeds();

/** Reads the configuration of the server and the user. @throws {import('./api.js').ApiError} */
export async function loadUser() {
  const me = api.get('/api/me');
  me.catch(() => {}); // reported below
  store.config = await api.get('/config.json').catch(() => store.config);
  store.me = await me;
  store.notify('me');
}
