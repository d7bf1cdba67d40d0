/** Applies the records of each topic to the store. */
import { applyPast, applyReport, nameOf, newEntity } from './entity.js';
import { differenceOf, fullKey, scope, scopeOf } from './identities.js';
import { markPercent } from './readings.js';

/** Maximum number of entities; beyond it the one with the oldest report is removed. */
const MAX_ENTITIES = 5_000;

/** @template T @param {T} Base @returns {T} with `apply…` methods that change the store by a record */
export const Reducers = (Base) => class extends Base {
  /** Applies a record of an entity. @returns {string[]} the keys of the changed entities */
  applyEntity(record) {
    if (record.value === null && !record.cut) {
      const deleted = this.identities.deletedBy(record);
      deleted.forEach((each) => this.forgetEntity(each));
      return deleted;
    }
    const identity = this.identities.identify(record);
    if (!identity) {
      return [];
    }
    const key = identity.key;
    let entity = this.entities.get(key);
    if (!entity) {
      entity = newEntity(identity);
      this.entities.set(key, entity);
      this.nameAll(identity);
    }
    if (record.cut) {
      entity.cut = record.cut;
      entity.time = Math.max(entity.time, record.time);
      entity.heard = Math.max(entity.heard, entity.time);
    } else if (typeof record.value === 'object' && !Array.isArray(record.value)) {
      applyReport(entity, record);
      this.applyHealth(entity);
    }
    entity.suspect = this.suspects.has(key);
    entity.state = this.stateOf(entity);
    this.notify('entities', key);
    this.entities.size > MAX_ENTITIES && this.forgetOldest();
    return [key];
  }

  /** Applies what the control plane remembers of a device: whether it ever reported its battery in percent. @returns {boolean} whether it is news */
  applyHealth(entity) {
    return Boolean(this.deviceOf(entity)?.health?.percent) && markPercent(entity.attributes);
  }

  forgetEntity(key) {
    const entity = this.entities.get(key);
    if (entity) {
      this.entities.delete(key);
      this.identities.forget(entity.identity);
      this.nameAll(entity.identity);
      this.all = true;
      this.notify('entities', key);
    }
  }

  /** Updates the names of all entities with the same id, which contain how they differ. */
  nameAll(identity) {
    for (const { key } of this.identities.all(identity.id)) {
      const entity = this.entities.get(key);
      if (entity) {
        entity.difference = this.identities.difference(entity.identity);
        entity.name = nameOf(entity);
        this.notify('entities', key);
      }
    }
  }

  /**
   * Applies reports from before the page was opened: for trails and series, and those that `data.latest` lacks.
   *
   * @param {import('./stream.js').TopicRecord[]} records oldest first
   */
  applyPast(records) {
    const reports = new Map();
    for (const record of records) {
      const isDeleted = record.value === null && !record.cut;
      const keys = isDeleted ? this.identities.deletedBy(record) : [this.identities.identify(record)?.key ?? null];
      keys.forEach((key) => reports.has(key) ? reports.get(key).push(record) : reports.set(key, [record]));
    }
    reports.delete(null);
    for (const [key, history] of reports) {
      const latest = this.entities.get(key)?.time ?? -Infinity;
      const newer = history.filter((each) => each.time > latest);
      const deleted = newer.findLastIndex((each) => each.value === null && !each.cut);
      newer.slice(Math.max(0, deleted)).forEach((each) => this.applyEntity(each));
      const entity = this.entities.get(key);
      if (entity && latest > -Infinity) {
        applyPast(entity, history.filter((each) => each.time <= latest));
        entity.state = this.stateOf(entity);
        this.notify('entities', key);
      }
    }
  }

  forgetOldest() {
    let oldest = null;
    for (const each of this.entities.values()) {
      oldest = oldest === null || each.time < oldest.time ? each : oldest;
    }
    this.forgetEntity(oldest.id);
  }

  /** The keys of entities that a record names by id, and by type if known. @param {{headers: Object=}} record @returns {string[]} */
  keysOf({ headers }, ids, types) {
    return ids.map((id, i) => this.identities.keyOf(id, scopeOf(headers), types?.[i]));
  }

  /** The keys of the two devices of an encounter. A record names the scope of the second if it differs. */
  keysOfPair({ value, headers }) {
    const of = (name) => value[name]?.value;
    const first = scopeOf(headers);
    const second = of('Device2_servicePath') ? scope(of('Device2_service'), of('Device2_servicePath')) : first;
    return [[1, first], [2, second]].map(([number, its]) => this.identities.keyOf(String(of(`Device${number}_ID`)), its, of(`Device${number}_type`)));
  }

  applyEncounter(record) {
    const value = record.value;
    if (!value || value.type !== 'Analytics:Collision') {
      return;
    }
    const of = (name) => value[name]?.value;
    const phase = of('phase');
    if (typeof of('Device1_ID') !== 'string' || typeof of('Device2_ID') !== 'string') {
      return;
    }
    const [a, b] = this.keysOfPair(record);
    const pair = `${a}|${b}`;
    const existing = this.encounters.get(pair);
    if (existing && existing.time > record.time) {
      return;
    }
    if (phase === 'predicted' && existing && (existing.phase === 'started' || existing.phase === 'ongoing')) {
      return;
    }
    this.encounters.set(pair, {
      pair, a, b, phase, id: of('encounter'),
      distance: of('distance'), minDistance: of('minDistance') ?? of('dcpa') ?? of('distance'),
      time: record.time, start: of('startTime') ?? record.time, tcpa: of('tcpa'),
      at: [[of('Device1_longitude'), of('Device1_latitude')], [of('Device2_longitude'), of('Device2_latitude')]],
    });
    this.notify('encounters');
  }

  /** Shows an encounter of a replay's time that was found while it was recorded. */
  applyRecordedEncounter({ id, a, b, start, end, closest }) {
    const now = this.now();
    const pair = `${a}|${b}`;
    const isOver = now > end;
    if (now >= start && (!isOver || this.encounters.get(pair)?.phase === 'ongoing')) {
      const unknown = [NaN, NaN];
      this.encounters.set(pair, { pair, a, b, id, phase: isOver ? 'ended' : 'ongoing', distance: Infinity, minDistance: closest, time: Math.min(now, end), start, at: [unknown, unknown] });
      this.notify('encounters');
    }
  }

  /** @param {string=} mission of a replay: each mission of a group has its averages */
  applyTemperature(record, mission = '') {
    const value = record.value;
    const of = (name) => value?.[name]?.value;
    // the field may arrive later, from another topic; devices of several tenants may be in it
    const field = of('field');
    const its = scopeOf(record.headers);
    const key = fullKey(its, mission, field);
    const averages = this.averages.get(field) ?? new Map();
    if (value?.type !== 'Analytics:FieldTemperature' || averages.get(key)?.time > record.time) {
      return;
    }
    const suspects = this.keysOf(record, Array.isArray(of('suspects')) ? of('suspects') : [], of('suspectTypes'));
    this.averages.set(field, averages.set(key, {
      ...its, mission, value: of('averageTemperature'), count: of('devices'), time: record.time, suspects,
      verified: of('quality') !== 'unverified', quality: of('quality'), window: [of('windowStart'), of('windowEnd')],
    }));
    averages.forEach((each) => { each.difference = differenceOf(each, [...averages.values()]); });
    for (const [device, suspect] of this.suspects) {
      if (suspect.average === key && !suspects.includes(device)) {
        this.suspects.delete(device);
        this.updateSuspect(device);
      }
    }
    for (const device of suspects) {
      this.suspects.set(device, { average: key, mean: of('averageTemperature'), time: record.time });
      this.updateSuspect(device);
    }
    this.notify('suspects');
    this.notify('fields');
  }

  applyCoverage(record) {
    this.coverages.apply(record) && this.notify('coverages');
  }

  /** The averages of a field, one per tenant, service path and replayed mission of its devices. */
  averagesOf(field) {
    return [...this.averages.get(field)?.values() ?? []];
  }

  updateSuspect(id) {
    const entity = this.entities.get(id);
    if (entity) {
      entity.suspect = this.suspects.has(id);
      entity.state = this.stateOf(entity);
      this.notify('entities', id);
    }
  }

  /** Applies a version of a field, or its deletion; a key without a time stands for all versions. */
  applyField({ key, value }) {
    const [, id, time] = /^(.+)@([^@]*)$/s.exec(key) ?? [null, key, null];
    const versions = this.fieldVersions.get(id) ?? new Map();
    if (value) {
      versions.set(Date.parse(time) || 0, value);
    } else {
      time === null ? versions.clear() : versions.delete(Date.parse(time) || 0);
    }
    this.fieldVersions.set(id, versions);
    this.showField(id);
  }

  /** Selects the version of a field that is valid at the page's time. */
  showField(id) {
    const field = this.fieldAt(id, this.now());
    if (this.fields.get(id)?.version !== field?.version) {
      field ? this.fields.set(id, field) : this.fields.delete(id);
      this.notify('fields');
    }
  }

  /** The version of a field that is valid at a time; undefined if there is none. */
  fieldAt(id, time) {
    const versions = this.fieldVersions.get(id);
    const validFrom = Math.max(...[...versions?.keys() ?? []].filter((from) => from <= time));
    const version = versions?.get(validFrom);
    const properties = version?.properties ?? {};
    return version?.geometry && {
      id, version, validFrom, properties, geometry: version.geometry, name: typeof properties.name === 'string' ? properties.name : id,
      exclusion: properties.kind === 'exclusion' || properties.zone !== undefined,
    };
  }

  applyImage(record) {
    const image = record.value;
    if (image?.entity) {
      // the camera's entity may arrive later, and another entity may have its id
      this.images.set(fullKey(scopeOf(record.headers), image.type ?? '', image.entity), { ...image, time: record.time });
      this.keysOf(record, [image.entity], [image.type]).forEach((key) => this.notify('images', key));
    }
  }

  /** The newest image of an entity; images of an older job lack its type. */
  imageOf({ identity }) {
    return this.images.get(fullKey(identity, identity.type, identity.id)) ?? this.images.get(fullKey(identity, '', identity.id));
  }

  applyAlarm(record) {
    record.value ? this.alarms.set(record.key, record.value) : this.alarms.delete(record.key);
    this.notify('alarms');
  }
};
