/** The number of stored events of missions per bucket, as counted by the control plane. */
import { api } from '../core/api.js';

const DEBOUNCE = 120;
const POLL_INTERVAL = 1_000;
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
    /** Start of a bucket → number of events; null if not counted yet. */
    this.counts = new Map();
    this.highest = 0;
    this.complete = false;
    this.error = null;
  }

  /**
   * Loads the counts of a period. @param {string[]} missions @param {number} from epoch ms @param {number} to epoch ms @param {number} buckets
   * maximum number
   */
  request(missions, from, to, buckets) {
    const key = `${missions} ${from} ${to} ${buckets}`;
    if (key !== this.key) {
      this.key = key;
      this.attempts = 0;
      this.schedule(() => this.load(missions, from, to, buckets), DEBOUNCE);
    }
  }

  schedule(task, wait) {
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
      this.schedule(() => this.load(missions, from, to, buckets), this.error ? 5 * POLL_INTERVAL : POLL_INTERVAL);
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
        const sum = this.counts.get(start);
        this.counts.set(start, count === null || sum === null ? null : (sum ?? 0) + count);
      });
    }
    this.highest = Math.max(0, ...this.counts.values());
  }
}

/** The counts of a mission; null if nothing of it is stored in the period. */
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
