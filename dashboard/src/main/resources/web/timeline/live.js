/** How much came in during the last quarter of an hour. */
import { api } from '../core/api.js';
import { store } from '../core/store.js';

export const LIVE_LENGTH = 15 * 60_000;
/** As short as it may be where little came yet: some buckets. */
const SHORTEST = 20_000;
const WIDTH = 5_000;
const TOPIC = 'data.raw';

/** Buckets that are over are as Kafka counts them; the newest one grows by what the page receives. */
export class LiveDensity {
  /** @param {function()} changed */
  constructor(changed) {
    this.changed = changed;
    this.width = WIDTH;
    this.counts = new Map();
    this.highest = 0;
    this.complete = true;
    this.error = null;
    this.seen = null;
    this.countedTo = null;
    this.requestedAt = 0;
  }

  /** Counts what came since the last call. Called each second, and when the page is seen again. */
  tick() {
    const now = Date.now();
    const start = Math.floor(now / WIDTH) * WIDTH;
    const count = store.topics.get(TOPIC)?.count ?? null;
    // what came while nobody counted, as in a replay, comes with the next answer
    const came = this.seen === null || count === null || count < this.seen ? 0 : count - this.seen;
    this.seen = count;
    this.counts.set(start, (this.counts.get(start) ?? 0) + came);
    for (const old of this.counts.keys()) {
      old < now - LIVE_LENGTH - WIDTH && this.counts.delete(old);
    }
    this.show();
    if (start !== this.countedTo && now - this.requestedAt >= WIDTH) {
      this.requestedAt = now;
      this.request(start);
    }
  }

  /** The buckets up to the newest: all at first, then those since the last answer, and two before, as records may be late. */
  async request(start) {
    const from = this.countedTo === null ? start - LIVE_LENGTH : Math.max(start - LIVE_LENGTH, this.countedTo - 2 * WIDTH);
    try {
      const { counts } = await api.get(`/api/density/${TOPIC}?${new URLSearchParams({ from, to: start + WIDTH, width: WIDTH })}`);
      this.countedTo = start;
      const counted = this.counts.get(start) ?? 0; // may have gone on since Kafka answered
      counts.forEach((count, index) => this.counts.set(from + index * WIDTH, count));
      this.counts.set(start, Math.max(counted, this.counts.get(start) ?? 0));
      this.show();
    } catch {
      // until it is asked again the page's own count stands
    }
  }

  /** From the first record of the last quarter of an hour to now. */
  extent() {
    const now = Date.now();
    return [this.countedTo === null ? now - LIVE_LENGTH : Math.max(now - LIVE_LENGTH, Math.min(now - SHORTEST, this.first)), now];
  }

  /** When the first of what is counted came, epoch ms. */
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
