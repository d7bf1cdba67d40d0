/** Signs users in and out: with a token, or by the pages of a proxy. */
import { api } from './core/api.js';
import { h, replace } from './core/dom.js';
import { icon } from './core/icons.js';
import { store } from './core/store.js';
import { t } from './texts.js';

/** Set while the user is at the proxy, so that a user who returns without being signed in is not redirected again. */
const AT_PROXY = 'furrow-signing-in';

/** Signs in by a link with `#token=…`, and removes the token from the address bar. */
export function readTokenFromLink() {
  const found = /^#token=([^&]+)/.exec(location.hash);
  if (found) {
    api.token = decodeURIComponent(found[1]);
    history.replaceState(null, '', `${location.pathname}#/map`);
  }
}

export function signedIn() {
  sessionStorage.removeItem(AT_PROXY);
}

/** Shows the form, or redirects to the proxy. @param {function()} start continues with a token */
export function signIn(start) {
  const wrong = Boolean(api.token);
  api.token = null;
  const { signIn: url } = store.config;
  if (url && !wrong && !sessionStorage.getItem(AT_PROXY)) {
    return goTo(url);
  }
  const token = h('input', { type: 'password', id: 'token', name: 'token', autocomplete: 'current-password', required: true, 'aria-describedby': 'token-hint' });
  const submit = async (event) => {
    event.preventDefault();
    api.token = token.value.trim();
    start();
  };
  const problem = wrong ? 'signIn.wrong' : url && 'signIn.notByProxy';
  replace(document.body, h('main.sign-in', null, h('form', { on: { submit } },
    h('div.brand', null, icon('furrow', 26), t('app.title')),
    h('h1', null, t('signIn.title')),
    problem && h('p.error-note', { role: 'alert' }, icon('warning'), t(problem)),
    url && [h('button.button.primary', { type: 'button', on: { click: () => goTo(url) } }, t('signIn.byProxy')), h('p.muted.sign-in-or', null, t('signIn.or'))],
    h('div.field-row', null, h('label', { for: 'token' }, t('signIn.token')), token, h('p.small.muted', { id: 'token-hint' }, t('signIn.hint'))),
    h('button.button', { type: 'submit', class: url ? '' : 'primary' }, t(url ? 'signIn.submitToken' : 'signIn.submit')))));
  url || token.focus();
}

/** Signs in during a session. */
export function signInAgain() {
  store.config.signIn && !api.token ? goTo(store.config.signIn) : location.reload();
}

export function canSignOut() {
  return Boolean(api.token || store.config.signOut);
}

export function signOut() {
  if (api.token) {
    api.token = null;
    location.reload();
  } else {
    location.assign(withPage(store.config.signOut, location.pathname));
  }
}

function goTo(url) {
  sessionStorage.setItem(AT_PROXY, 'yes');
  location.assign(withPage(url, `${location.pathname}${location.search}${location.hash}`));
}

/** Fills in the address to return to: a path for a proxy with the page's own origin, else a URL. */
function withPage(url, path) {
  const page = new URL(url, location.href).origin === location.origin ? path : new URL(path, location.href).href;
  return url.replaceAll('{page}', encodeURIComponent(page));
}
