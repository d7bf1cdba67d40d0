/** Under which key the page has an entity: tenant, service path, type and id tell entities apart, not the id alone. */

/** Where an entity lives in the context broker, as the headers of its records name it. */
export function scopeOf(headers) {
  return scope(headers?.['fiware-service'], headers?.['fiware-servicepath']);
}

/** @returns {{service: string, servicePath: string}} as the server compares them */
export function scope(service, servicePath) {
  return { service: (service ?? '').trim().toLowerCase(), servicePath: (servicePath ?? '').trim() || '/' };
}

/**
 * The entities of each id. The first of them has the id as its key, each other one a key that holds all of its identity: links, alarms and
 * whatever else names an entity by its id alone lead to the first.
 */
export class Identities {
  constructor() {
    this.byId = new Map();
  }

  /** @param {import('./stream.js').TopicRecord} record of an entity @returns {{key: string, id: string, service: string, servicePath: string, type: string}|null} */
  identify(record) {
    const { id, type, of } = identityOf(record);
    if (!id) {
      return null;
    }
    const all = this.all(id);
    const find = (isType) => all.find((each) => isIn(each, of) && isType(each));
    // one that was too large to be sent may have come without its type
    let found = find((each) => each.type === type) ?? find((each) => type === '' || each.type === '');
    if (!found) {
      const key = all.some((each) => each.key === id) ? fullKey(of, type, id) : id;
      found = { key, id, ...of, type };
      this.byId.set(id, [...all, found]);
    }
    found.type ||= type;
    return found;
  }

  /** @param {import('./stream.js').TopicRecord} record a deletion; without a type it is one of all entities of its id @returns {string[]} their keys */
  deletedBy(record) {
    const { id, type, of } = identityOf(record);
    return this.all(id).filter((each) => isIn(each, of) && (type === '' || each.type === type)).map((each) => each.key);
  }

  /** The key of an entity that is named by its id: in the scope if there is one, else in any. With a type it is that of no other entity. */
  keyOf(id, of, type = '') {
    const all = this.all(id);
    const found = type ? all.find((each) => isIn(each, of) && (each.type === type || each.type === '')) : all.find((each) => isIn(each, of)) ?? all[0];
    return found?.key ?? (all.length ? fullKey(of, type, id) : id);
  }

  /** The key of the first entity that has an id and a type; one of any type where none has. */
  keyOfType(id, type) {
    const all = this.all(id);
    return (all.find((each) => each.type === type) ?? all[0])?.key;
  }

  /** How an entity differs from others of its id; empty where there are none. */
  difference({ key, id }) {
    const all = this.all(id);
    const own = all.find((each) => each.key === key);
    const parts = ['type', 'service', 'servicePath'].filter((part) => all.some((each) => each[part] !== own?.[part]));
    return own ? parts.map((part) => own[part]).filter(Boolean).join(' ') : '';
  }

  forget({ key, id }) {
    const rest = this.all(id).filter((each) => each.key !== key);
    rest.length ? this.byId.set(id, rest) : this.byId.delete(id);
  }

  all(id) {
    return this.byId.get(id) ?? [];
  }
}

/** All that tells an entity from others. */
export function fullKey({ service, servicePath }, type, id) {
  return [service, servicePath, type, id].join('|');
}

export function isIn(identity, { service, servicePath }) {
  return identity.service === service && identity.servicePath === servicePath;
}

/** A record without a value has its id in its key only, which may hold the rest of its identity too. */
function identityOf({ key, value, headers }) {
  const of = scopeOf(headers);
  const type = text(value?.type) || text(headers?.['entity-type']);
  let id = value && typeof value === 'object' ? value.id ?? key : key;
  if (!value && typeof key === 'string') {
    const prefix = `${escaped(of.service)}|${escaped(of.servicePath)}|`;
    id = key.startsWith(prefix) ? key.slice(prefix.length) : key;
    id = type && id.endsWith(` ${type}`) ? id.slice(0, -type.length - 1) : id;
  }
  return { id: text(id), type, of };
}

function escaped(part) {
  return part.replaceAll('%', '%25').replaceAll('|', '%7C');
}

function text(value) {
  return typeof value === 'string' ? value : '';
}
