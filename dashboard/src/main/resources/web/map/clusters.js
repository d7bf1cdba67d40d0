/** Combines many devices at one spot into one symbol with their number. */

/** Up to this number of devices in view, each is drawn individually. */
const MAX_INDIVIDUAL = 60;
/** Cell size, px; symbols in one cell overlap. */
export const CELL = 40;
const MIN_MEMBERS = 4;
const RANK = { attention: 3, stale: 2, off: 1, ok: 0 };

/**
 * Clusters the devices in view.
 *
 * @param {{entity: Object, x: number, y: number}[]} spots in view
 * @param {function(Object): boolean} isSingle whether an entity is drawn individually in any case
 * @param {{x: number, y: number}} origin a point that moves with the map, so that panning does not change clusters
 * @returns {{single: Object[], clusters: {x: number, y: number, count: number, state: string, spots: Object[]}[]}}
 */
export function cluster(spots, isSingle, origin) {
  if (spots.length <= MAX_INDIVIDUAL) {
    return { single: spots, clusters: [] };
  }
  const cells = new Map();
  const single = [];
  for (const spot of spots) {
    if (isSingle(spot.entity)) {
      single.push(spot);
      continue;
    }
    const key = Math.floor((spot.x - origin.x) / CELL) * 100_003 + Math.floor((spot.y - origin.y) / CELL);
    const cell = cells.get(key);
    cell ? cell.push(spot) : cells.set(key, [spot]);
  }
  const clusters = [];
  for (const members of cells.values()) {
    members.length < MIN_MEMBERS ? single.push(...members) : clusters.push(summary(members));
  }
  return { single, clusters };
}

function summary(spots) {
  let [x, y, state] = [0, 0, 'ok'];
  for (const spot of spots) {
    x += spot.x / spots.length;
    y += spot.y / spots.length;
    state = RANK[spot.entity.state] > RANK[state] ? spot.entity.state : state;
  }
  return { x, y, state, count: spots.length, spots };
}

export function drawCluster(context, { x, y, count, state }, palette) {
  const radius = Math.min(CELL / 2, 10 + 2 * Math.log2(count));
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = palette.panel;
  context.fill();
  context.lineWidth = 2.5;
  context.strokeStyle = state === 'attention' ? palette.warning : state === 'stale' ? palette.muted : palette['kind-sensor'];
  context.setLineDash(state === 'stale' ? [4, 3] : []);
  context.stroke();
  context.setLineDash([]);
  context.font = `600 12px ${palette.family}`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillStyle = palette.text;
  context.fillText(String(count), x, y + 0.5);
  return radius;
}
