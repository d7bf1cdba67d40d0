/** The menu with the user, the color scheme and signing out. */
import { h, replace } from './core/dom.js';
import { icon } from './core/icons.js';
import { chooseLanguage, language, languages } from './core/language.js';
import { word } from './core/format.js';
import { store } from './core/store.js';
import { canSignOut, signOut } from './sign-in.js';
import { t, texts } from './texts.js';

export function settingsMenu() {
  const schemes = h('div', { role: 'group', 'aria-label': t('app.scheme') });
  const { user, role } = store.me;
  const list = h('div.scheme-menu', { id: 'settings', popover: 'auto' },
    user && h('p.me.small', null, h('strong', null, user), h('span.muted', null, ` · ${word(role)}`)),
    schemes,
    h('div', { role: 'group', 'aria-label': t('app.language') }, Object.entries(languages).map(([name, words]) =>
      h('button.button.quiet', { type: 'button', lang: name, 'aria-pressed': String(name === language), on: { click: () => chooseLanguage(name) } },
        icon(name === language ? 'check' : 'language', 18), words))),
    canSignOut() && h('button.button.quiet', { type: 'button', on: { click: signOut } }, icon('leave', 18), t('app.signOut')));
  const symbols = { system: 'contrast', dark: 'moon', light: 'sun', sunlight: 'sun' };
  const draw = () => replace(schemes, Object.entries(texts.app.schemes).map(([name, words]) => {
    const chosen = (localStorage.getItem('furrow-scheme') ?? 'system') === name;
    return h('button.button.quiet', {
      type: 'button', 'aria-pressed': String(chosen),
      on: { click: () => { chooseScheme(name); draw(); list.hidePopover(); } },
    }, icon(chosen ? 'check' : symbols[name], 18), words);
  }));
  draw();
  return h('div.menu', null,
    h('button.button.quiet.square', { type: 'button', 'aria-label': t('app.settings'), title: t('app.settings'), popovertarget: 'settings' }, icon('contrast', 18)), list);
}

function chooseScheme(name) {
  name === 'system' ? localStorage.removeItem('furrow-scheme') : localStorage.setItem('furrow-scheme', name);
  window.dispatchEvent(new Event('schemechosen'));
}
