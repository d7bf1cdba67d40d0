/** Resources of the REST API that are refreshed while they are shown. */
import { api } from './api.js';
import { streams } from './stream.js';

const DEBOUNCE = 250;
/** Maximum share of the time spent on fetching: a slow resource is fetched less often. */
const BUSY_SHARE = 0.2;

/**
 * Fetches a resource, again after each record of the topics and every `interval` ms.
 *
 * @param {string} path
 * @param {{topics: string[]=, interval: number=, read: (function(string): Promise)=}} options `read` fetches the value of the path, by default as
 *     JSON
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
        refreshIfVisible();
      }
    });
    return running;
  }

  async function load() {
    const startedAt = performance.now();
    try {
      self.value = await read(path);
      self.error = null;
    } catch (error) {
      self.error = error;
    }
    took = performance.now() - startedAt;
    self.loading = false;
    if (!closed) {
      handlers.forEach((handler) => handler(self));
    }
  }

  /** Refreshes unless the page is hidden; then it refreshes once it is visible again. */
  const refreshIfVisible = () => document.hidden || refresh();
  const schedule = () => {
    pending ??= setTimeout(() => {
      pending = null;
      refreshIfVisible();
    }, Math.max(DEBOUNCE, took / BUSY_SHARE));
  };
  const visible = () => document.hidden || schedule();
  const subscriptions = topics.map((topic) =>
    streams.subscribe(topic, { mode: 'latest', prime: false }, { records: schedule, state: (state) => state === 'open' && schedule() }));
  const ticking = interval ? setInterval(refreshIfVisible, interval) : undefined;
  document.addEventListener('visibilitychange', visible);
  refresh();
  return self;
}
