/** Routes views of the page by the hash: `#/map?select=urn:…`. */

const VIEWS = ['map', 'missions', 'replays', 'analyses', 'history', 'topics', 'platform'];
/** Time before and after an encounter of which pictures are shown, ms. */
const AROUND_MILLIS = 30_000;
const handlers = new Set();

/** @type {{view: string, query: Object<string, string>}} */
export let route = read();

function read() {
  const [path, query = ''] = location.hash.replace(/^#\/?/, '').split('?');
  return { view: VIEWS.includes(path) ? path : 'map', query: Object.fromEntries(new URLSearchParams(query)) };
}

/** The hash of a view. */
export function linkTo(view, query = {}) {
  const present = Object.entries(query).filter(([, value]) => value !== null && value !== undefined);
  const text = new URLSearchParams(present).toString();
  return `#/${view}${text ? `?${text}` : ''}`;
}

/** The hash of the pictures around an encounter. @param {number} from @param {number} to epoch ms */
export function picturesAround(select, from, to) {
  return linkTo('history', { select, between: `${from - AROUND_MILLIS}~${to + AROUND_MILLIS}`, pictures: 'all' });
}

export function navigate(view, query = {}) {
  location.hash = linkTo(view, query);
}

/**
 * Changes parameters of the address without a new entry in the history; null removes one. No handler is called.
 *
 * @param {string=} view the only one that has them
 */
export function amendAddress(changes, view) {
  route = read(); // the address may lead elsewhere already, and its event is yet to come
  if (view !== undefined && route.view !== view) {
    return;
  }
  const link = linkTo(route.view, { ...route.query, ...changes });
  if (link !== linkTo(route.view, route.query)) {
    history.replaceState(history.state, '', link);
    route = read();
  }
}

/**
 * Keeps in the address what the user looks at, so that a reload and a sent link show the same. A link with the parameter sets it; a link without it
 * changes nothing.
 *
 * @param {string} name of the parameter
 * @param {{view: string=, get: function(): (string|null|undefined), set: function(string)=}} options `view`: the only one that has it
 * @returns {{write: function(), close: function()}} `write` is called after each change
 */
export function parameter(name, { view, get, set }) {
  const write = () => amendAddress({ [name]: get() || null }, view);
  const follow = () => {
    const linked = view === undefined || route.view === view ? route.query[name] : undefined;
    linked !== undefined && linked !== get() && set?.(linked);
    write();
  };
  const close = onRoute(follow);
  follow();
  return { write, close };
}

export function onRoute(handler) {
  handlers.add(handler);
  return () => handlers.delete(handler);
}

window.addEventListener('hashchange', () => {
  route = read();
  handlers.forEach((handler) => handler(route));
});
