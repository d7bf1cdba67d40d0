/** Adds map tiles as the lowest layer, if the server has some: by a URL, or from a PMTiles file. */
import { h } from '../core/dom.js';
import { store } from '../core/store.js';
import { PmtilesFile } from './pmtiles.js';

/** The class of the layer, which the style sheet mutes. */
const CLASS = 'map-tiles';

/** @returns {{layers: object[], attribution: HTMLElement}} */
export function tiles() {
  const attribution = h('p.map-attribution', { hidden: true });
  const { tiles: url, tileFile } = store.config;
  const source = tileFile ? fileSource(new PmtilesFile(tileFile), attribution) : url && new ol.source.XYZ({ url });
  return { layers: source ? [layer(source)] : [], attribution };
}

function layer(source) {
  const created = new ol.layer.Tile({ className: CLASS, zIndex: 0 });
  Promise.resolve(source).then((ready) => created.setSource(ready), (error) => console.warn('map tiles cannot be drawn:', error.message));
  return created;
}

async function fileSource(file, attribution) {
  const { minZoom, maxZoom } = await file.header();
  file.metadata().then((metadata) => attribute(attribution, metadata.attribution), (error) => console.warn('map tiles:', error.message));
  const nothing = document.createElement('canvas');
  return new ol.source.ImageTile({
    minZoom, maxZoom, transition: 0,
    loader: async (z, x, y, { signal }) => {
      const picture = await file.tile(z, x, y, signal);
      return picture ? createImageBitmap(picture) : nothing;
    },
  });
}

/** Shows the attribution as text; files contain it as markup. */
function attribute(element, markup) {
  if (typeof markup === 'string' && markup) {
    element.textContent = new DOMParser().parseFromString(markup, 'text/html').body.textContent;
    element.hidden = false;
  }
}
