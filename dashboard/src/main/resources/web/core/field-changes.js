/** Changes fields by the REST API. Each change writes a version to `service.fields`; to undo one writes the version before it again. */
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

/** Undoes the newest change. */
export async function undoLast() {
  const change = lastChange();
  const version = await change.inverse();
  changes.splice(changes.indexOf(change), 1);
  const earlier = changes.findLast(({ id }) => id === change.id);
  earlier && (earlier.version = version);
}

/** Whether another version of the field was written after a change: its undoing takes back that one too. */
export function isChangedSince({ id, version }) {
  return version !== null && newest(id) !== version;
}

export function pathOf({ id }) {
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
async function write({ id, geometry, properties: { validFrom, ...properties } }) {
  const before = newest(id);
  const answer = await api.post('/api/fields', { type: 'Feature', id, geometry, properties });
  if (answer.refused?.length) {
    throw new Error(answer.refused[0].reason);
  }
  return arrival(id, before);
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
