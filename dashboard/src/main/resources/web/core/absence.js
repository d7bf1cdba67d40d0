/** What stands in the place of a list that is empty: three states that must not be taken for one another. */
import { h } from './dom.js';
import { icon } from './icons.js';
import { store } from './store.js';

/**
 * Shows that a list of the store is being read, why it could not be, or that it is empty. A failure is also shown above a list that was read before.
 *
 * @param {string} name of the list in the store
 * @param {number} count of the entries that are shown
 * @param {function(): Node} empty says that there are none
 * @returns {Node|false}
 */
export function absence(name, count, empty) {
  const { loading, error } = store.lists[name];
  return error ? h('p.error-note', { role: 'alert' }, icon('warning'), h('span', null, error.message))
    : count === 0 && (loading ? h('div.stack', { 'aria-busy': 'true' }, [0, 1, 2].map(() => h('div.skeleton.list-skeleton', null, '…'))) : empty());
}
