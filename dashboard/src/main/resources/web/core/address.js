/** Keeps in the address what all views share: the replay, the domain and mission in scope, the selected device, and the search. */
import { api } from './api.js';
import { amendAddress, onRoute, parameter, route } from './router.js';
import { store } from './store.js';

/** @param {function(string)} announce reports why a link could not be followed @returns {(function())[]} functions that unsubscribe */
export function keepAddress(announce) {
  let linked = null;

  /** Enters the replay of a link, `#/map?replay=R&at=ISO`, once it is known. */
  async function enterLinked() {
    const replay = linked && store.replays.get(linked.replay);
    if (!replay?.topic) {
      return;
    }
    const { at } = linked;
    linked = null;
    store.mode.replay === replay.replay || store.enterReplay(replay);
    amendAddress({ at: null });
    if (at && store.may('operate')) {
      const to = Number.isNaN(Number(at)) ? at : Number(at);
      await api.post(`/api/replays/${encodeURIComponent(replay.replay)}/seek`, { to }).catch((error) => announce(error.message));
    }
  }

  function followLink() {
    const { view, query } = route;
    query.select && store.select(query.select, { reveal: !query.place });
    const at = view === 'map' ? query.at : undefined; // of other views it is their own
    if (query.replay && (at || query.replay !== store.mode.replay)) {
      linked = { replay: query.replay, at };
      enterLinked();
    }
  }

  const closeRoute = onRoute(followLink);
  followLink();
  const kept = {
    scope: parameter('scope', {
      get: () => store.scope.domain && [store.scope.domain, store.scope.mission].filter(Boolean).join('.'),
      set: (text) => { const [domain, mission] = text.split('.'); store.setScope({ domain, mission }); },
    }),
    selection: parameter('select', { get: () => store.selection }),
    filter: parameter('find', { get: () => store.filter, set: (text) => store.setFilter(text) }),
    mode: parameter('replay', { get: () => (store.isReplay ? store.mode.replay : linked?.replay) }),
  };
  return [closeRoute, store.on('replays', enterLinked), ...Object.entries(kept).flatMap(([name, { write, close }]) => [store.on(name, write), close])];
}
