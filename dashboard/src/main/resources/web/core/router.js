/** Routes views of the page by the hash: `#/map?select=urn:…`. */

const VIEWS = ['map', 'missions', 'replays', 'analyses', 'topics', 'platform'];
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

export function navigate(view, query = {}) {
  location.hash = linkTo(view, query);
}

/** Replaces the query of the address, so that a reload shows the same; no handler is called. */
export function keepInAddress(query) {
  history.replaceState(history.state, '', linkTo(route.view, query));
  route = read();
}

export function onRoute(handler) {
  handlers.add(handler);
  return () => handlers.delete(handler);
}

window.addEventListener('hashchange', () => {
  route = read();
  handlers.forEach((handler) => handler(route));
});
