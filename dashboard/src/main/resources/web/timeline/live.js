/** Counts the records of the last quarter of an hour. */
import { api } from '../core/api.js';
import { exists } from '../core/existing.js';
import { store } from '../core/store.js';

export const LIVE_LENGTH = 15 * 60_000;
/** Minimum length shown while there are few records: some buckets. */
const MIN_LENGTH = 20_000;
const WIDTH = 5_000;
const ALL = 'data.raw';

/** Counts per bucket: of complete buckets as counted by Kafka; of the newest one, as received by the page. */
export class LiveDensity {
  /** @param {function()} changed */
  constructor(changed) {
    this.changed = changed;
    this.width = WIDTH;
    this.complete = true;
    this.error = null;
    this.begin(ALL);
  }

  begin(topic) {
    Object.assign(this, { topic, counts: new Map(), highest: 0, seen: null, countedTo: null, requestedAt: 0 });
  }

  /** Counts the records received since the last call. Called each second, and when the page becomes visible again. */
  tick() {
    const topic = topicOfScope();
    topic === this.topic || this.begin(topic);
    const now = Date.now();
    const start = Math.floor(now / WIDTH) * WIDTH;
    const count = store.topics.get(topic)?.count ?? null; // of a domain or mission only Kafka counts
    // records that arrived while nothing was counted, as in a replay, are part of the next response
    const received = this.seen === null || count === null || count < this.seen ? 0 : count - this.seen;
    this.seen = count;
    this.counts.set(start, (this.counts.get(start) ?? 0) + received);
    for (const old of this.counts.keys()) {
      old < now - LIVE_LENGTH - WIDTH && this.counts.delete(old);
    }
    this.show();
    if (store.primed && start !== this.countedTo && now - this.requestedAt >= WIDTH) {
      this.requestedAt = now;
      this.request(start);
    }
  }

  /** Requests the buckets up to the newest: all at first, then those since the last response and two before it, as records may be late. */
  async request(start) {
    const { topic } = this;
    const from = this.countedTo === null ? start - LIVE_LENGTH : Math.max(start - LIVE_LENGTH, this.countedTo - 2 * WIDTH);
    try {
      if (topic !== ALL && !(await exists(topic))) {
        return;
      }
      const { counts } = await api.get(`/api/density/${topic}?${new URLSearchParams({ from, to: start + WIDTH, width: WIDTH })}`);
      if (topic !== this.topic) {
        return;
      }
      this.countedTo = start;
      const counted = this.counts.get(start) ?? 0; // may have increased since Kafka answered
      counts.forEach((count, index) => this.counts.set(from + index * WIDTH, count));
      this.counts.set(start, Math.max(counted, this.counts.get(start) ?? 0));
      this.show();
    } catch {
      // the page's own count is used until the next request
    }
  }

  /** From the first counted record of the last quarter of an hour to now. */
  extent() {
    const now = Date.now();
    return [this.countedTo === null ? now - LIVE_LENGTH : Math.max(now - LIVE_LENGTH, Math.min(now - MIN_LENGTH, this.first)), now];
  }

  /** Start of the first bucket with records, epoch ms. */
  get first() {
    let first = Infinity;
    this.counts.forEach((count, start) => count > 0 && (first = Math.min(first, start)));
    return first;
  }

  show() {
    this.highest = Math.max(0, ...this.counts.values());
    this.changed();
  }
}

/** The topic with the reports of the scope. */
function topicOfScope() {
  const { domain, mission } = store.scope;
  return domain === null ? ALL : [`data.${domain}.realtime`, mission].filter(Boolean).join('.');
}
