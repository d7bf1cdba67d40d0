/** Tells that a view shows only the chosen domain or mission. */
import { h } from './dom.js';
import { nameFromTopic } from './identities.js';
import { store } from './store.js';
import { t } from '../texts.js';

/** "farm › weeding". */
export function scopeName() {
  return [store.scope.domain, store.scope.mission].filter(Boolean).map(nameFromTopic).join(' › ');
}

/** A button that shows all entries of a list again, if some are outside of the scope. @param {number} count of these */
export function others(count) {
  return count > 0 && h('button.button.quiet.small.others', { type: 'button', data: { act: 'others' }, on: { click: () => store.setScope({}) } }, t('app.others', { count, scope: scopeName() }));
}
