/** Groups fields and devices that lie near each other into farms. */
import { store } from '../core/store.js';
import { project } from './projection.js';

/** Width of a cell of the grid, meters of the projection: farms are at least one empty cell apart. */
const CELL = 2_000;
/** Cells of a large field that are looked at, per axis. */
const MAX_CELLS = 40;
/** Number of devices that make a farm without a field; fewer may be lost. */
const MIN_DEVICES = 3;
/**
 * Devices farther from the median than `OUTLIER_SPREADS` times the interquartile range, and at least `MIN_SPREAD` meters, do not widen the first
 * view.
 */
const OUTLIER_SPREADS = 8;
const MIN_SPREAD = 250;

/**
 * A farm.
 *
 * @typedef {Object} Farm
 * @property {string} key the same as long as its first field or device is
 * @property {string} name
 * @property {Object[]} fields of the store
 * @property {Object[]} devices entities of the store
 */

/**
 * @param {{field: Object, box: number[]}[]} fields with their boxes in meters of the projection
 * @param {{entity: Object, point: number[]}[]} devices
 * @returns {Farm[]} the one with the most devices that report first
 */
export function farmsOf(fields, devices) {
  const grid = new Grid();
  const items = [...fields.map(({ field, box }) => ({ field, cell: grid.add(box) })), ...devices.map(({ entity, point }) => ({ entity, cell: grid.add([...point, ...point]) }))];
  grid.joinNeighbors();
  const groups = new Map();
  for (const { field, entity, cell } of items) {
    const root = grid.find(cell);
    const group = groups.get(root) ?? { fields: [], devices: [], reporting: 0 };
    field ? group.fields.push(field) : group.devices.push(entity);
    group.reporting += entity?.state === 'ok' || entity?.state === 'attention' ? 1 : 0;
    groups.set(root, group);
  }
  const all = [...groups.values()].sort((a, b) => b.reporting - a.reporting || b.fields.length - a.fields.length || b.devices.length - a.devices.length);
  const farms = all.filter((each) => each.fields.length > 0 || each.devices.length >= MIN_DEVICES);
  return named(farms.length ? farms : all.slice(0, 1));
}

/** Names farms by their domains, and those of one domain also by a field. */
function named(farms) {
  const words = farms.map(({ fields, devices }) => {
    const domain = fields.find((each) => each.properties.Domain)?.properties.Domain ?? devices.find((each) => each.domain)?.domain;
    return store.domains.get(domain)?.name ?? domain;
  });
  return farms.map(({ fields, devices }, index) => {
    const first = (fields[0] ?? devices[0]).name;
    const isSame = words.filter((each) => each === words[index]).length > 1;
    return { key: fields[0]?.id ?? devices[0].id, name: !words[index] ? first : isSame ? `${words[index]} · ${first}` : words[index], fields, devices };
  });
}

/** Cells with something in them, joined to groups. */
class Grid {
  constructor() {
    this.parents = new Map();
  }

  /** @param {number[]} box min x, min y, max x, max y @returns {string} one of its cells, which are joined */
  add([left, bottom, right, top]) {
    const [x0, y0, x1, y1] = [left, bottom, right, top].map((each) => Math.floor(each / CELL));
    const first = `${x0} ${y0}`;
    for (let x = x0; x <= x1; x += Math.max(1, Math.ceil((x1 - x0) / MAX_CELLS))) {
      for (let y = y0; y <= y1; y += Math.max(1, Math.ceil((y1 - y0) / MAX_CELLS))) {
        const cell = `${x} ${y}`;
        this.parents.has(cell) || this.parents.set(cell, cell);
        this.join(first, cell);
      }
    }
    return first;
  }

  joinNeighbors() {
    for (const cell of this.parents.keys()) {
      const [x, y] = cell.split(' ').map(Number);
      for (const neighbor of [`${x + 1} ${y}`, `${x} ${y + 1}`, `${x + 1} ${y + 1}`, `${x - 1} ${y + 1}`]) {
        this.parents.has(neighbor) && this.join(cell, neighbor);
      }
    }
  }

  find(cell) {
    while (this.parents.get(cell) !== cell) {
      cell = this.parents.get(cell);
    }
    return cell;
  }

  join(one, other) {
    this.parents.set(this.find(one), this.find(other));
  }
}

/** The extent of devices without outliers, so that a lost one does not shrink the farm to a dot. */
export function extentOf(devices) {
  const points = devices.map((each) => project(...each.position));
  const [x, y] = [0, 1].map((axis) => distributionOf(points.map((point) => point[axis])));
  const reach = Math.max(x.spread, y.spread, MIN_SPREAD) * OUTLIER_SPREADS;
  const near = points.filter((point) => Math.abs(point[0] - x.median) <= reach && Math.abs(point[1] - y.median) <= reach);
  return ol.extent.buffer(ol.extent.boundingExtent(near.length ? near : points), 50);
}

function distributionOf(values) {
  const sorted = values.sort((a, b) => a - b);
  const at = (share) => sorted[Math.floor(share * (sorted.length - 1))];
  return { median: at(0.5), spread: at(0.75) - at(0.25) };
}
