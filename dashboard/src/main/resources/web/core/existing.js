/** Tells which topics exist. Those of results are created with their first record, and a request for one that does not exist is an error in the console. */
import { api } from './api.js';

/** @param {string} topic @returns {Promise<boolean>} @throws {import('./api.js').ApiError} */
export async function exists(topic) {
  const found = await api.get(`/api/topics?${new URLSearchParams({ name: topic })}`);
  return found.some(({ name }) => name === topic);
}
