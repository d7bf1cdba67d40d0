/** Shows the dashboard's map with its store, without the rest of the page. */
import { store } from '/core/store.js';
import '/map/map.js';
import { count, play } from './feed.js';

const [west, south, east, north] = await (await fetch('/frames/extent')).json();
const middle = (west + east) / 2;
[[west, middle - 0.0001], [middle + 0.0001, east]].forEach(([left, right], index) => store.applyField({
  key: `field-${index}@2026-01-01T00:00:00.000Z`,
  value: {
    type: 'Feature', properties: { name: `Field ${index + 1}`, rowDirection: 12 + 60 * index, rowSpacing: 3 },
    geometry: { type: 'Polygon', coordinates: [[[left, south], [right, south], [right, north], [left, north], [left, south]]] },
  },
}));
store.primed = true;
count(document.querySelector('furrow-map').map);
setInterval(() => store.tick(), 1000);
play(({ records }) => {
  records.forEach((record) => store.applyEntity(record));
  window.devices = store.entities.size;
});
