/** Answers of the REST API that are kept fresh while somebody looks at them. */
import { api } from './api.js';
import { streams } from './stream.js';

const DEBOUNCE = 250;
/** A list that takes long to fetch is fetched less often: at most this share of the time. */
const BUSY_SHARE = 0.2;

/**
 * @param {string} path
 * @param {{topics: string[]=, interval: number=, read: (function(string): Promise)=}} options asked again when a record comes on one of the topics, and every `interval` ms;
 *   `read` makes the value of the path, else it is the JSON
 * @returns {{value: *, error: Error|null, loading: boolean, on: function(function()): function(), refresh: function(): Promise, close: function()}}
 */
export function resource(path, { topics = [], interval = 0, read = api.get } = {}) {
  const handlers = new Set();
  let closed = false;
  let pending = null;
  let running = null;
  let again = false;
  let took = 0;

  const self = {
    value: null,
    error: null,
    loading: true,
    on(handler) {
      handlers.add(handler);
      return () => handlers.delete(handler);
    },
    refresh,
    close() {
      closed = true;
      clearTimeout(pending);
      clearInterval(ticking);
      subscriptions.forEach((each) => each.close());
      document.removeEventListener('visibilitychange', visible);
    },
  };

  async function refresh() {
    if (running) {
      again = true;
      return running;
    }
    running = load().finally(() => {
      running = null;
      if (again && !closed) {
        again = false;
        refreshIfSeen();
      }
    });
    return running;
  }

  async function load() {
    const begun = performance.now();
    try {
      self.value = await read(path);
      self.error = null;
    } catch (error) {
      self.error = error;
    }
    took = performance.now() - begun;
    self.loading = false;
    if (!closed) {
      handlers.forEach((handler) => handler(self));
    }
  }

  /** What a hidden page leaves out is fetched when it is seen again. */
  const refreshIfSeen = () => document.hidden || refresh();
  const soon = () => {
    pending ??= setTimeout(() => {
      pending = null;
      refreshIfSeen();
    }, Math.max(DEBOUNCE, took / BUSY_SHARE));
  };
  const visible = () => document.hidden || soon();
  const subscriptions = topics.map((topic) =>
    streams.subscribe(topic, { mode: 'latest', prime: false }, { records: soon, state: (state) => state === 'open' && soon() }));
  const ticking = interval ? setInterval(refreshIfSeen, interval) : undefined;
  document.addEventListener('visibilitychange', visible);
  refresh();
  return self;
}
