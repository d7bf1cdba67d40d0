/** Tells which topics exist. Those of results are created with their first record, and a request for one that does not exist is an error in the console. */
import { api } from './api.js';

/** Age of the list that is still used, ms. */
const FRESH_MILLIS = 1_000;
let names = null;
let requestedAt = -Infinity;

/** @param {string} topic @returns {Promise<boolean>} @throws {import('./api.js').ApiError} */
export async function exists(topic) {
  const now = performance.now();
  if (now - requestedAt > FRESH_MILLIS) {
    requestedAt = now;
    names = api.get('/api/topics').then((topics) => new Set(topics.map(({ name }) => name)));
  }
  return (await names).has(topic);
}
