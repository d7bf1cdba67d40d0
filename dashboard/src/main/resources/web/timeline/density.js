/** How many events missions have, bucket by bucket, as the control plane counts them in what is stored. */
import { api } from '../core/api.js';

const DEBOUNCE = 120;
const AGAIN = 1_000;
const MAX_ATTEMPTS = 60;

export class Density {
  /** @param {function()} changed called when there is more to draw */
  constructor(changed) {
    this.changed = changed;
    this.clear();
  }

  clear() {
    clearTimeout(this.timer);
    this.abort?.abort();
    this.key = null;
    /** Width of a bucket, ms. */
    this.width = 0;
    /** Start of a bucket → events; null for one that is not counted yet. */
    this.counts = new Map();
    this.highest = 0;
    this.complete = false;
    this.error = null;
  }

  /** @param {string[]} missions @param {number} from epoch ms @param {number} to @param {number} buckets at most */
  want(missions, from, to, buckets) {
    const key = `${missions} ${from} ${to} ${buckets}`;
    if (key !== this.key) {
      this.key = key;
      this.attempts = 0;
      this.soon(() => this.load(missions, from, to, buckets), DEBOUNCE);
    }
  }

  soon(task, wait) {
    clearTimeout(this.timer);
    this.timer = setTimeout(task, wait);
  }

  async load(missions, from, to, buckets) {
    this.abort?.abort();
    const { signal } = (this.abort = new AbortController());
    const query = new URLSearchParams({ from: Math.floor(from), to: Math.ceil(to), buckets });
    try {
      const answers = await Promise.all(missions.map((mission) => timeline(mission, query, signal)));
      if (signal.aborted) {
        return;
      }
      this.merge(answers.filter(Boolean));
      this.error = null;
    } catch (error) {
      if (signal.aborted) {
        return;
      }
      this.error = error;
      this.complete = error.status !== 0 && error.status !== 503;
    }
    if (!this.complete && ++this.attempts < MAX_ATTEMPTS) {
      this.soon(() => this.load(missions, from, to, buckets), this.error ? 5 * AGAIN : AGAIN);
    }
    this.changed();
  }

  merge(answers) {
    this.width = answers[0]?.width ?? 0;
    this.counts = new Map();
    this.complete = answers.every((each) => each.complete);
    for (const answer of answers) {
      answer.counts.forEach((count, index) => {
        const start = answer.from + index * answer.width;
        const before = this.counts.get(start);
        this.counts.set(start, count === null || before === null ? null : (before ?? 0) + count);
      });
    }
    this.highest = Math.max(0, ...this.counts.values());
  }
}

/** Null where nothing of the mission is stored in that stretch. */
async function timeline(mission, query, signal) {
  try {
    return await api.get(`/api/recordings/${encodeURIComponent(mission)}/timeline?${query}`, { signal });
  } catch (error) {
    if (error.status === 404 || error.status === 400) {
      return null;
    }
    throw error;
  }
}
