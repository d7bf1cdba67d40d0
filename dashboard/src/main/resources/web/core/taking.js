/** What the records of each topic change in the store. */
import { newEntity, takePast, takeReport } from './entity.js';

/** Most entities that are kept; beyond it those not heard of for longest go. */
const MOST_ENTITIES = 5_000;

/** @template T @param {T} Base @returns {T} with `take…` */
export const Taking = (Base) => class extends Base {
  /** @param {import('./stream.js').TopicRecord} record of an entity */
  takeEntity(record) {
    const id = record.value?.id ?? record.key;
    if (typeof id !== 'string' || id === '') {
      return;
    }
    if (record.value === null && !record.cut) {
      if (this.entities.delete(id)) {
        this.all = true;
        this.tell('entities', id);
      }
      return;
    }
    let entity = this.entities.get(id);
    if (!entity) {
      entity = newEntity(id);
      this.entities.set(id, entity);
      this.entities.size > MOST_ENTITIES && this.forgetOldest();
    }
    if (record.cut) {
      entity.cut = record.cut;
      entity.time = Math.max(entity.time, record.time);
    } else if (typeof record.value === 'object' && !Array.isArray(record.value)) {
      takeReport(entity, record);
    }
    entity.suspect = this.suspects.has(id);
    entity.state = this.stateOf(entity);
    this.tell('entities', id);
  }

  /**
   * What was reported before the page was opened: lines and trails, and what `data.latest` did not have yet.
   *
   * @param {import('./stream.js').TopicRecord[]} records oldest first
   */
  takePast(records) {
    const reports = new Map();
    records.forEach((record) => reports.has(record.key) ? reports.get(record.key).push(record) : reports.set(record.key, [record]));
    for (const [id, of] of reports) {
      const known = this.entities.get(id)?.time ?? -Infinity;
      const newer = of.filter((each) => each.time > known);
      const deleted = newer.findLastIndex((each) => each.value === null && !each.cut);
      newer.slice(Math.max(0, deleted)).forEach((each) => this.takeEntity(each));
      const entity = this.entities.get(id);
      if (entity && known > -Infinity) {
        takePast(entity, of.filter((each) => each.time <= known));
        entity.state = this.stateOf(entity);
        this.tell('entities', id);
      }
    }
  }

  forgetOldest() {
    let oldest = null;
    for (const each of this.entities.values()) {
      oldest = oldest === null || each.time < oldest.time ? each : oldest;
    }
    this.entities.delete(oldest.id);
    this.all = true;
  }

  takeEncounter(record) {
    const value = record.value;
    if (!value || value.type !== 'Analytics:Collision') {
      return;
    }
    const of = (name) => value[name]?.value;
    const [a, b, phase] = [of('Device1_ID'), of('Device2_ID'), of('phase')];
    if (typeof a !== 'string' || typeof b !== 'string') {
      return;
    }
    const pair = `${a}|${b}`;
    const known = this.encounters.get(pair);
    if (known && known.time > record.time) {
      return;
    }
    if (phase === 'withdrawn') {
      this.encounters.delete(pair);
      this.tell('encounters');
      return;
    }
    if (phase === 'predicted' && known && (known.phase === 'started' || known.phase === 'ongoing')) {
      return;
    }
    this.encounters.set(pair, {
      pair, a, b, phase, id: of('encounter'),
      distance: of('distance'), minDistance: of('minDistance') ?? of('dcpa') ?? of('distance'),
      time: record.time, start: of('startTime') ?? record.time, tcpa: of('tcpa'),
      at: [[of('Device1_longitude'), of('Device1_latitude')], [of('Device2_longitude'), of('Device2_latitude')]],
    });
    this.tell('encounters');
  }

  takeTemperature(record) {
    const value = record.value;
    const of = (name) => value?.[name]?.value;
    const field = of('field');
    // the field itself may come later: its topic is another one
    if (value?.type !== 'Analytics:FieldTemperature' || this.averages.get(field)?.time > record.time) {
      return;
    }
    const suspects = Array.isArray(of('suspects')) ? of('suspects') : [];
    this.averages.set(field, {
      value: of('averageTemperature'), count: of('devices'), time: record.time, suspects,
      verified: of('quality') !== 'unverified', quality: of('quality'), window: [of('windowStart'), of('windowEnd')],
    });
    for (const [device, suspect] of this.suspects) {
      if (suspect.field === field && !suspects.includes(device)) {
        this.suspects.delete(device);
        this.remark(device);
      }
    }
    for (const device of suspects) {
      this.suspects.set(device, { field, mean: of('averageTemperature'), time: record.time });
      this.remark(device);
    }
    this.tell('suspects');
    this.tell('fields');
  }

  remark(id) {
    const entity = this.entities.get(id);
    if (entity) {
      entity.suspect = this.suspects.has(id);
      entity.state = this.stateOf(entity);
      this.tell('entities', id);
    }
  }

  /** A version of a field, or that it is taken back; a key without a time stands for all of them. */
  takeField({ key, value }) {
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

  /** Of the versions of a field the one that holds at the time of what is shown. */
  showField(id) {
    const now = this.now();
    const versions = this.fieldVersions.get(id);
    const validFrom = Math.max(...[...versions.keys()].filter((from) => from <= now));
    const version = versions.get(validFrom);
    if (this.fields.get(id)?.version === version) {
      return;
    }
    if (version?.geometry) {
      const properties = version.properties ?? {};
      this.fields.set(id, {
        id, version, validFrom, properties, geometry: version.geometry, name: typeof properties.name === 'string' ? properties.name : id,
        exclusion: properties.kind === 'exclusion' || properties.zone !== undefined,
      });
    } else if (!this.fields.delete(id)) {
      return;
    }
    this.tell('fields');
  }

  takeImage(record) {
    const image = record.value;
    if (image?.entity) {
      this.images.set(image.entity, { ...image, time: record.time });
      this.tell('images', image.entity);
    }
  }

  takeAlarm(record) {
    record.value ? this.alarms.set(record.key, record.value) : this.alarms.delete(record.key);
    this.tell('alarms');
  }

  /** All alarms that there were are known. */
  alarmsRead() {
    this.alarmsKnown = true;
    this.tell('alarms');
  }
};
