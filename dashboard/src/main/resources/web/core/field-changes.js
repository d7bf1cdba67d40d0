/** Changes fields by the REST API. To undo a change is another one, which writes what was there before it. */
import { api } from './api.js';
import { formRow, openDialog } from './dialog.js';
import { h } from './dom.js';
import { ofLocal, timeElement } from './local-time.js';
import { store } from './store.js';
import { t } from '../texts.js';

/** Maximum number of changes that can be undone. */
const MAX_CHANGES = 50;
/** Maximum time until a version that was written is received, ms. */
const ARRIVAL_MILLIS = 5_000;
/** The changes of this page, the newest last. */
const changes = [];

/**
 * A field to be written.
 *
 * @typedef {Object} Draft
 * @property {string} id
 * @property {Object} geometry GeoJSON, Polygon or MultiPolygon
 * @property {Object} properties `name`, `Domain`, `kind`, `crop`, `rowDirection` and others
 */

/** The newest change, if it can be undone. @returns {{words: string, id: string, version: number}|undefined} */
export function lastChange() {
  return changes.at(-1);
}

/**
 * Writes a version of a field, valid from now.
 *
 * @param {Draft} draft @param {Draft|null} before the field as it was, null if it is new @param {string} words name the change for its undoing
 * @throws {Error} if it is rejected
 */
export async function writeField(draft, before, words) {
  const version = await write(draft);
  remember({ words, id: draft.id, version, inverse: () => (before ? write(before) : writeEnd(draft.id)) });
}

/** Ends a field. @param {Object} field of the store @param {number|null} at epoch ms; null for now */
async function endField(field, at) {
  const version = await writeEnd(field.id, at);
  at ?? remember({ words: t('draw.ended', { field: field.name }), id: field.id, version, inverse: () => write(field) });
}

/** Renames a field in all its versions. @param {Object} field of the store @param {string} name */
export async function renameField(field, name) {
  const rename = async (words) => {
    await api.patch(pathOf(field), { name: words });
    return newest(field.id);
  };
  const version = await rename(name);
  remember({ words: t('draw.renamed', { field: field.name }), id: field.id, version, inverse: () => rename(field.name) });
}

/** Deletes a field with all its versions. @param {Object} field of the store */
export async function deleteField(field) {
  const versions = [...store.fieldVersions.get(field.id)].sort(([one], [other]) => one - other);
  await api.del(pathOf(field));
  remember({ words: t('draw.deleted', { field: field.name }), id: field.id, version: -Infinity, inverse: () => writeVersions(field.id, versions) });
}

/** Undoes the newest change, or asks first if the field was changed since. @param {function(string)} done @param {function(Error)} failed if it is rejected */
export function askUndo(done, failed) {
  const change = lastChange();
  const work = async () => {
    await undoLast();
    done(t('draw.undone', { change: change.words }));
  };
  if (isChangedSince(change)) {
    openDialog({ title: t('draw.undo', { change: change.words }), submit: t('draw.undoAnyway'), danger: true, body: [h('p', null, t('draw.changedSince'))], work });
  } else {
    work().catch(failed);
  }
}

async function undoLast() {
  const change = lastChange();
  const version = await change.inverse();
  changes.splice(changes.indexOf(change), 1);
  const earlier = changes.findLast(({ id }) => id === change.id);
  earlier && (earlier.version = version);
  store.notify('fields');
}

/** Whether another version of the field was written after a change: its undoing takes back that one too. */
function isChangedSince({ id, version }) {
  return version !== null && newest(id) !== version;
}

function pathOf({ id }) {
  return `/api/fields/${encodeURIComponent(id)}`;
}

/** Asks when to end a field, and ends it. */
export function askEnd(field, title) {
  const time = timeElement();
  openDialog({
    title: `${title}?`, submit: t('missions.end'), danger: true, body: [h('p', null, t('missions.endText')), formRow(t('missions.endAt'), time, t('missions.endHint'))],
    work: () => endField(field, time.value ? ofLocal(time.value, true) : null),
  });
}

/** An id for a new field, readable in topics; ids of fields that ended are not used again. */
export function idFor(name) {
  const base = name.normalize('NFKD').toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '').slice(0, 60) || 'field';
  let id = base;
  for (let number = 2; store.fieldVersions.has(id); number++) {
    id = `${base}-${number}`;
  }
  return id;
}

function remember(change) {
  changes.push(change);
  changes.length > MAX_CHANGES && changes.shift();
  store.notify('fields'); // for those who offer to undo it
}

/** @returns {Promise<number|null>} the version's `validFrom`, null if it is not received in time */
async function write(draft) {
  const before = newest(draft.id);
  await post(draft);
  return arrival(draft.id, before);
}

/** @param {Draft} draft @param {string} query with the time from which it is valid; empty for now */
async function post({ id, geometry, properties: { validFrom, ...properties } }, query = '') {
  const answer = await api.post(`/api/fields${query}`, { type: 'Feature', id, geometry, properties });
  if (answer.refused?.length) {
    throw new Error(answer.refused[0].reason);
  }
}

/** Writes versions of a field that was deleted, of which some may be ends. @returns {Promise<number>} the newest version's `validFrom` */
async function writeVersions(id, versions) {
  for (const [validFrom, { geometry, properties }] of versions) {
    await (geometry ? post({ id, geometry, properties: properties ?? {} }, `?validFrom=${validFrom}`) : api.patch(pathOf({ id }), { validTo: new Date(validFrom).toISOString() }));
  }
  return versions.at(-1)[0];
}

async function writeEnd(id, at = null) {
  const before = newest(id);
  // the clock of the page may be behind that of the server, and a field cannot end before it begins
  await api.patch(pathOf({ id }), { validTo: new Date(at ?? Math.max(Date.now(), before + 1)).toISOString() });
  return arrival(id, before);
}

/** The time from which the newest version of a field is valid; -Infinity if there is none. */
function newest(id) {
  return Math.max(...store.fieldVersions.get(id)?.keys() ?? []);
}

/** Waits until another version of a field is received, so that the map shows it. */
function arrival(id, before) {
  return new Promise((resolve) => {
    const arrived = () => {
      const version = newest(id);
      if (version !== before) {
        finish(version);
      }
    };
    const finish = (version) => {
      off();
      clearTimeout(timeout);
      resolve(version);
    };
    const off = store.on('fields', arrived);
    const timeout = setTimeout(() => finish(null), ARRIVAL_MILLIS);
    arrived();
  });
}
