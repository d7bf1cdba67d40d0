/** Loads OpenLayers, which is no module, at the start: its evaluation takes long, and the page then waits for the server anyway. */
export const library = new Promise((loaded, failed) => {
  document.head.append(Object.assign(document.createElement('script'), { src: '/lib/ol/ol.js', onload: loaded, onerror: () => failed(new Error('/lib/ol/ol.js')) }));
});
library.catch(() => {}); // the map reports it
