/** Assigns keys to entities: they are distinguished by tenant, service path, type and id, not by id alone. */

/** The tenant and service path of an entity, from the headers of its records. */
export function scopeOf(headers) {
  return scope(headers?.['fiware-service'], headers?.['fiware-servicepath']);
}

/** @returns {{service: string, servicePath: string}} normalized as on the server */
export function scope(service, servicePath) {
  return { service: (service ?? '').trim().toLowerCase(), servicePath: (servicePath ?? '').trim().replace(/(?<=.)\/+$/, '') || '/' };
}

/**
 * Indexes entities by id. The key of the first entity with an id is that id; the key of each further one is its whole identity. Links, alarms and
 * others that name only an id thus lead to the first.
 */
export class Identities {
  constructor() {
    this.byId = new Map();
  }

  /**
   * Finds or adds the entity of a record. @param {import('./stream.js').TopicRecord} record @returns {{key: string, id: string, service: string,
   * servicePath: string, type: string}|null}
   */
  identify(record) {
    const { id, type, of } = identityOf(record);
    if (!id) {
      return null;
    }
    const all = this.all(id);
    const find = (isType) => all.find((each) => isIn(each, of) && isType(each));
    // a record whose value was too large to be sent may lack the type
    let found = find((each) => each.type === type) ?? find((each) => type === '' || each.type === '');
    if (!found) {
      const key = all.some((each) => each.key === id) ? fullKey(of, type, id) : id;
      found = { key, id, ...of, type };
      this.byId.set(id, [...all, found]);
    }
    found.type ||= type;
    return found;
  }

  /**
   * The keys of the entities that a record deletes. @param {import('./stream.js').TopicRecord} record a deletion; without a type it deletes all
   * entities with its id @returns {string[]}
   */
  deletedBy(record) {
    const { id, type, of } = identityOf(record);
    return this.all(id).filter((each) => isIn(each, of) && (type === '' || each.type === type)).map((each) => each.key);
  }

  /** The key of an entity by its id: in the scope if there is one, else in any. With a type, never the key of an entity with another type. */
  keyOf(id, of, type = '') {
    const all = this.all(id);
    const found = type ? all.find((each) => isIn(each, of) && (each.type === type || each.type === '')) : all.find((each) => isIn(each, of)) ?? all[0];
    return found?.key ?? (all.length ? fullKey(of, type, id) : id);
  }

  /** The key of the first entity with an id and type, else of the first with that id. */
  keyOfType(id, type) {
    const all = this.all(id);
    return (all.find((each) => each.type === type) ?? all[0])?.key;
  }

  /** The key of the entity of a device of the REST API: in its scope if there is one, else in any. */
  keyOfDevice({ id, type, service, servicePath }) {
    const all = this.all(id).filter((each) => !type || !each.type || isSameType(each.type, type));
    return (all.find((each) => isIn(each, scope(service, servicePath))) ?? all[0])?.key;
  }

  /** How an entity differs from others with its id; empty if there are none. */
  difference({ key, id }) {
    const all = this.all(id);
    const own = all.find((each) => each.key === key);
    return own ? differenceOf(own, all) : '';
  }

  forget({ key, id }) {
    const rest = this.all(id).filter((each) => each.key !== key);
    rest.length ? this.byId.set(id, rest) : this.byId.delete(id);
  }

  all(id) {
    return this.byId.get(id) ?? [];
  }
}

/** The type, scope and mission of one of all that share an id, as far as they differ. */
export function differenceOf(own, all) {
  return ['type', 'service', 'servicePath', 'mission'].filter((part) => all.some((each) => each[part] !== own[part])).map((part) => own[part]).filter(Boolean).join(' ');
}

/** A name with the difference, if any, to others with the same id. */
export function withDifference(name, difference) {
  return difference ? `${name} (${difference.slice(0, 80)})` : name;
}

/** The whole identity of an entity as a key. */
export function fullKey({ service, servicePath }, type, id) {
  return [service, servicePath, type, id].join('|');
}

/** The name of a domain or mission from its part of a topic, see `TopicName` of the model; a hash stays. */
export function nameFromTopic(part) {
  try {
    return part?.startsWith('_x-') ? decodeURIComponent(part.slice(3).replaceAll('-', '%')) : part;
  } catch { // a topic of another program
    return part;
  }
}

/** Whether two names of a domain or mission, as reported or in topics, are the same. @param {string|null|undefined} one @param {string} other */
export function isSameName(one, other) {
  return one === other || nameFromTopic(one) === nameFromTopic(other);
}

/** Robots of FIROS write their type in upper case. */
export function isSameType(one, other) {
  return one.toLowerCase() === other.toLowerCase();
}

export function isIn(identity, { service, servicePath }) {
  return identity.service === service && identity.servicePath === servicePath;
}

/** The identity of a record. A record without a value has its id only in its key, which may contain the rest of the identity too. */
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
