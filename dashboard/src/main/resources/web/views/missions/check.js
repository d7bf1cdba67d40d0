/** Checks the devices of a plan before a mission starts. */
import { chargeOf } from '../../core/readings.js';
import { store } from '../../core/store.js';

const LOW_BATTERY = 20;
const OLD_REPORT = 5 * 60_000;
/** Maximum number of devices of a group that are checked individually. */
const MAX_CHECKED = 200;
const ORDER = ['ok', 'unknown', 'warning', 'problem'];

/**
 * A finding about a device.
 *
 * @typedef {{level: 'ok'|'warning'|'problem'|'unknown', what: 'reach'|'battery'|'place'|'use', text: string, values: Object}} Finding text: a key of
 *     the page's texts
 */

/** The current state of the farm; entities of a replay are not used. */
export function farmNow(mission) {
  // the devices of all missions have the same tenant and service path
  const [{ service, servicePath } = {}] = store.devices.values();
  const entityOf = (device) => (store.isReplay ? undefined : store.entityOf({ service, servicePath, ...device }));
  return { mission, now: Date.now(), devices: store.devices, missions: store.missions, fields: store.fields, entityOf };
}

/**
 * Checks a plan.
 *
 * @param {(string|Object)[]} groups of a plan or template
 * @param {string} domain
 * @param {{mission: string|null, now: number, devices: Map, entityOf: function(Object), missions: Map, fields: Map}} farm `now` in epoch ms
 * @returns {{name: string, findings: Finding[], worst: string}[]} one per device, and one for all devices of a group that do not exist yet
 */
export function checkPlan(groups, domain, farm) {
  return groups.flatMap((group) => checkGroup(typeof group === 'string' ? { id: group, outside: true } : group, domain, farm));
}

function checkGroup(group, domain, farm) {
  if (group.id) {
    return [checkDevice(group.id, group, domain, farm)];
  }
  const count = group.count ?? 1;
  const ids = Array.from({ length: Math.min(count, MAX_CHECKED) }, (_, index) => `urn:ngsi-ld:${group.type}:${farm.mission}-${index + 1}`);
  const existing = ids.filter((id) => farm.devices.has(id));
  const rest = count - existing.length;
  return [
    ...existing.map((id) => checkDevice(id, group, domain, farm)),
    ...(rest > 0 ? [withWorst(group.name ?? group.type, [atStart(group, rest), place(group, null, domain, farm)])] : []),
  ];
}

function atStart(group, count) {
  return { level: 'ok', what: 'reach', text: group.simulated ? 'simulated' : 'made', values: { count } };
}

function checkDevice(id, group, domain, farm) {
  const listed = farm.devices.get(id);
  const entity = farm.entityOf({ type: group.type, ...listed, id });
  if (!listed && !entity && !group.outside) {
    return withWorst(id, [atStart(group, 1), place(group, null, domain, farm)]);
  }
  return withWorst(id, [use(listed, farm), reach(listed, entity, group, farm), battery(listed, entity), place(group, entity, domain, farm)].filter(Boolean));
}

function withWorst(name, findings) {
  const worst = findings.reduce((worse, each) => (ORDER.indexOf(each.level) > ORDER.indexOf(worse) ? each.level : worse), 'ok');
  return { name, findings, worst };
}

/** A simulated device that its host switched off is expected to be silent until the mission starts. */
function reach(listed, entity, { outside }, { now }) {
  if (!outside && listed?.wanted === 'stopped') {
    return { level: 'ok', what: 'reach', text: 'off', values: {} };
  }
  const seen = Math.max(listed?.health?.heard ?? listed?.health?.lastSeen ?? 0, entity?.heard ?? 0);
  if (seen === 0) {
    return { level: outside ? 'warning' : 'unknown', what: 'reach', text: 'neverSeen', values: {} };
  }
  const silent = listed?.health?.silent ?? now - seen > OLD_REPORT;
  return { level: silent ? 'warning' : 'ok', what: 'reach', text: silent ? 'silent' : 'seen', values: { ago: now - seen } };
}

function battery(listed, entity) {
  const share = listed?.health?.battery ?? (entity && chargeOf(entity.attributes));
  if (typeof share !== 'number') {
    return { level: 'unknown', what: 'battery', text: 'noBattery', values: {} };
  }
  const percent = Math.round(share * 100);
  return { level: percent < LOW_BATTERY ? 'warning' : 'ok', what: 'battery', text: percent < LOW_BATTERY ? 'batteryLow' : 'battery', values: { percent } };
}

function use(listed, { missions, mission }) {
  const other = listed?.mission && listed.mission !== mission ? missions.get(listed.mission) : null;
  return other?.running && listed.wanted !== 'stopped' ? { level: 'problem', what: 'use', text: 'used', values: { mission: listed.mission } } : null;
}

/** Checks the position or start position of a device; a device that roams a field is inside it. */
function place(group, entity, domain, { fields }) {
  const roamed = typeof group.area === 'string' ? group.area : null;
  if (!entity?.position && roamed) {
    return fields.has(roamed)
      ? { level: 'ok', what: 'place', text: 'inside', values: { field: fields.get(roamed).name } }
      : { level: 'warning', what: 'place', text: 'noSuchField', values: { field: roamed } };
  }
  const point = entity?.position ?? group.path?.[0] ?? null;
  const own = [...fields.values()].filter((field) => !field.exclusion && (field.properties.Domain ?? domain) === domain);
  if (!point) {
    return { level: 'unknown', what: 'place', text: 'noPosition', values: {} };
  }
  if (own.length === 0) {
    return { level: 'unknown', what: 'place', text: 'noFields', values: {} };
  }
  const field = own.find((each) => isInside(each.geometry, point));
  return field
    ? { level: 'ok', what: 'place', text: 'inside', values: { field: field.name } }
    : { level: 'warning', what: 'place', text: 'outside', values: {} };
}

/** Whether a point is inside, by the even-odd rule over all rings; degrees are treated as a plane, which is exact enough for fields. */
function isInside(geometry, [x, y]) {
  const polygons = geometry?.type === 'Polygon' ? [geometry.coordinates] : geometry?.type === 'MultiPolygon' ? geometry.coordinates : [];
  return polygons.some((rings) => {
    let inside = false;
    for (const ring of rings) {
      for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
        const [[ax, ay], [bx, by]] = [ring[i], ring[j]];
        if ((ay > y) !== (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) {
          inside = !inside;
        }
      }
    }
    return inside;
  });
}
