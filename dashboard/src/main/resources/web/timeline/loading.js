/** Loads the encounters and markers of the timeline, and adds encounters from the stream. */
import { store } from '../core/store.js';
import { LIVE_LENGTH } from './live.js';
import { encountersIn, encountersOf, encountersSince, markersOf, union } from './moments.js';

/** Interval at which encounters and markers are read, ms. */
export const MOMENTS_INTERVAL = 15_000;
/** Encounters of a pair whose starts differ by at most this are the same one, ms. */
const SAME_START = 2_000;

/** @template T @param {T} Base @returns {T} with `encounters` and `markers` */
export const Loading = (Base) => class extends Base {
  async loadMoments() {
    const shown = this.shown;
    if (this.finding === shown || (store.isReplay && !this.bounded)) {
      return;
    }
    this.finding = shown;
    this.lastMoments = Date.now();
    try {
      const { results, missions } = store.mode;
      const [from, to] = this.extent;
      const [live, replayed, markers] = store.isReplay
        ? await Promise.all([encountersOf(missions, from, to).catch(() => ({ encounters: [] })), encountersIn((results.collision ?? []).map(({ topic }) => topic)).catch(() => []), markersOf(missions).catch(() => [])])
        : [{ encounters: await encountersSince(Date.now() - LIVE_LENGTH).catch(() => null) }, [], []];
      if (shown === this.shown && this.isConnected) {
        if (live.encounters === null) {
          this.lastMoments += MOMENTS_INTERVAL - LIVE_LENGTH; // the request failed and is repeated soon
          return;
        }
        this.encounters = union(live.encounters, replayed);
        this.markers = markers;
        this.flagKey = null;
        this.applyEncounters(); // those that arrived during the request
        this.showState();
      }
    } finally {
      this.finding = null;
    }
  }

  /** Applies encounters from the stream. */
  applyEncounters() {
    let changed = false;
    for (const each of store.encounters.values()) {
      if (!['started', 'ongoing', 'ended', 'crossed'].includes(each.phase)) {
        continue;
      }
      const existing = this.encounters.find((one) => one.a === each.a && one.b === each.b && Math.abs(one.start - each.start) <= SAME_START);
      if (existing) {
        existing.end = Math.max(existing.end, each.time);
        existing.closest = Math.min(existing.closest, each.minDistance);
      } else {
        const name = (id) => store.entities.get(id)?.name ?? id;
        this.encounters.push({ ...each, pair: `${name(each.a)} – ${name(each.b)}`, end: each.time, closest: each.minDistance, missions: [], epoch: 0 });
        changed = true;
      }
    }
    if (!store.isReplay) {
      this.encounters = this.encounters.filter((each) => each.end > Date.now() - LIVE_LENGTH);
    }
    changed && this.showState();
    this.redraw();
  }

  /** The encounters of devices in the scope. */
  get inScope() {
    return this.encounters.filter(({ a, b }) => store.isAboutScope([store.entities.get(a), store.entities.get(b)]));
  }
};
