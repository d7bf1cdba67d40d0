/** Stores one file in the browser, so that the page has it without a network and after it is closed. */

const DATABASE = 'furrow';
const STORE = 'files';

/** @param {string} key @returns {Promise<File|undefined>} */
export function storedFile(key) {
  return withStore('readonly', (store) => store.get(key));
}

/** @param {string} key @param {File} file @throws {DOMException} for instance if there is no room for it */
export function storeFile(key, file) {
  return withStore('readwrite', (store) => store.put(file, key));
}

export function removeFile(key) {
  return withStore('readwrite', (store) => store.delete(key));
}

async function withStore(mode, work) {
  const database = await result(Object.assign(indexedDB.open(DATABASE, 1), { onupgradeneeded: ({ target }) => target.result.createObjectStore(STORE) }));
  try {
    const transaction = database.transaction(STORE, mode);
    const request = work(transaction.objectStore(STORE));
    await new Promise((resolve, reject) => Object.assign(transaction, { oncomplete: resolve, onabort: () => reject(transaction.error), onerror: () => reject(transaction.error) }));
    return request.result;
  } finally {
    database.close();
  }
}

function result(request) {
  return new Promise((resolve, reject) => Object.assign(request, { onsuccess: () => resolve(request.result), onerror: () => reject(request.error) }));
}
