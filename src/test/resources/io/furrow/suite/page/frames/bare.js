/** Draws the same points with plain OpenLayers: one layer with a feature per device, which moves with each report. */
import { count, play } from './feed.js';

const colors = ['#7bd88f', '#6db7ff'];
const styles = colors.map((color) => new ol.style.Style({
  image: new ol.style.Circle({ radius: 7, fill: new ol.style.Fill({ color }), stroke: new ol.style.Stroke({ color: '#0e1411', width: 2 }) }),
}));
const source = new ol.source.Vector();
const view = new ol.View();
const map = new ol.Map({ target: 'map', view, controls: [], layers: [new ol.layer.Vector({ source })] });
view.fit(ol.proj.transformExtent(await (await fetch('/frames/extent')).json(), 'EPSG:4326', 'EPSG:3857'), { size: map.getSize(), padding: [36, 72, 84, 36] });
count(map);
const features = new Map();
play(({ records }) => {
  for (const { value } of records) {
    const place = ol.proj.fromLonLat([value.Longitude.value, value.Latitude.value]);
    const existing = features.get(value.id);
    if (existing) {
      existing.getGeometry().setCoordinates(place);
    } else {
      const feature = new ol.Feature(new ol.geom.Point(place));
      feature.setStyle(styles[features.size % 2]);
      features.set(value.id, feature);
      source.addFeature(feature);
    }
  }
  window.devices = features.size;
});
