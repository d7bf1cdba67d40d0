/** Map tiles below all else, where the server has some: by a URL, or out of a PMTiles file. */
import { h } from '../core/dom.js';
import { store } from '../core/store.js';
import { PmtilesFile } from './pmtiles.js';

/** In a layer of canvases of its own, which the style sheet mutes. */
const CLASS = 'map-tiles';

/** @returns {{layers: object[], attribution: HTMLElement}} */
export function tiles() {
  const attribution = h('p.map-attribution', { hidden: true });
  const { tiles: url, tileFile } = store.config;
  const source = tileFile ? fileSource(new PmtilesFile(tileFile), attribution) : url && new ol.source.XYZ({ url });
  return { layers: source ? [layer(source)] : [], attribution };
}

function layer(source) {
  const made = new ol.layer.Tile({ className: CLASS, zIndex: 0 });
  Promise.resolve(source).then((ready) => made.setSource(ready), (error) => console.warn('map tiles cannot be drawn:', error.message));
  return made;
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

/** Whose data it is, as text: files have it as markup. */
function attribute(element, markup) {
  if (typeof markup === 'string' && markup) {
    element.textContent = new DOMParser().parseFromString(markup, 'text/html').body.textContent;
    element.hidden = false;
  }
}
