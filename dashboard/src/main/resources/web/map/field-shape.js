/** The outline of one field on the map, which is drawn, or whose corners are moved. */
import { store } from '../core/store.js';
import { faultOf } from './outline.js';
import { project } from './projection.js';

const PROJECTION = 'EPSG:3857';
/** Distance at which a corner is caught, px: of a finger. */
const TOLERANCE = 14;

/** The field at a place of the map, the smallest of several; undefined if there is none. @param {number[]} coordinate of the projection */
export function fieldAt(coordinate) {
  return store.fieldsInScope().map((field) => ({ field, geometry: geometryOf(field) }))
    .filter(({ geometry }) => geometry.intersectsCoordinate(coordinate))
    .sort((a, b) => a.geometry.getArea() - b.geometry.getArea())[0]?.field;
}

function geometryOf(field) {
  return new ol.format.GeoJSON().readGeometry(field.geometry, { featureProjection: PROJECTION });
}

export class FieldShape {
  /** @param {Object} map of OpenLayers @param {function(): Object} palette @param {{drawn: function(), shaped: function()}} handlers */
  constructor(map, palette, handlers) {
    this.map = map;
    this.palette = palette;
    this.handlers = handlers;
    this.source = new ol.source.Vector();
    this.layer = new ol.layer.Vector({ className: 'map-drawing', zIndex: 4, source: this.source, style: (feature) => this.style(feature) });
    this.interactions = [];
    map.addLayer(this.layer);
    this.zoomByDoubleClick(false); // it ends an outline
  }

  close() {
    this.clear();
    this.map.removeLayer(this.layer);
    this.zoomByDoubleClick(true);
  }

  zoomByDoubleClick(active) {
    this.map.getInteractions().forEach((each) => each instanceof ol.interaction.DoubleClickZoom && each.setActive(active));
  }

  clear() {
    this.release();
    this.source.clear();
    this.feature = null;
  }

  /** Lets the user draw an outline. */
  draw() {
    this.clear();
    this.drawing = new ol.interaction.Draw({ type: 'Polygon', stopClick: true, freehandCondition: () => false, snapTolerance: TOLERANCE, style: (feature) => this.style(feature) });
    this.drawing.on('drawend', ({ feature }) => setTimeout(() => { // once the event is over
      this.show(null, feature);
      this.handlers.drawn();
    }));
    this.add(this.drawing);
    this.addSnap(null);
  }

  removeLast() {
    this.drawing?.removeLastPoint();
  }

  finish() {
    this.drawing?.finishDrawing();
  }

  /** Lets the user move the corners of an outline, and the whole. @param {Object|null} field of the store */
  show(field, feature = new ol.Feature(geometryOf(field))) {
    this.clear();
    this.feature = feature;
    this.source.addFeature(feature);
    const features = new ol.Collection([feature]);
    const moving = new ol.interaction.Translate({ features });
    const modifying = new ol.interaction.Modify({ features, pixelTolerance: TOLERANCE, style: (each) => this.style(each) });
    moving.on('translateend', () => this.shaped());
    modifying.on('modifyend', () => this.shaped());
    this.add(moving);
    this.add(modifying); // is asked first: a corner is not the inside
    this.addSnap(field);
  }

  shaped() {
    this.handlers.shaped();
  }

  /** Catches the borders of other fields. */
  addSnap(field) {
    const others = store.fieldsInScope().filter((each) => each.id !== field?.id).map((each) => new ol.Feature(geometryOf(each)));
    this.add(new ol.interaction.Snap({ features: new ol.Collection(others), pixelTolerance: TOLERANCE }));
  }

  add(interaction) {
    this.interactions.push(interaction);
    this.map.addInteraction(interaction);
  }

  release() {
    this.interactions.forEach((each) => this.map.removeInteraction(each));
    this.interactions = [];
    this.drawing = null;
  }

  /** GeoJSON in longitude and latitude. */
  get geometry() {
    return new ol.format.GeoJSON().writeGeometryObject(this.feature.getGeometry(), { featureProjection: PROJECTION, rightHanded: true, decimals: 8 });
  }

  /** Checks the outline, and marks the place of a fault. @returns {{text: string, at: number[]|null}|null} */
  fault() {
    const fault = faultOf(this.geometry);
    this.source.getFeatures().forEach((each) => each !== this.feature && this.source.removeFeature(each));
    if (fault?.at) {
      this.source.addFeature(new ol.Feature({ geometry: new ol.geom.Point(project(...fault.at)), isFault: true }));
    }
    return fault;
  }

  style(feature) {
    const { accent, critical, background } = this.palette();
    const color = feature.get('isFault') ? critical : accent;
    const isPoint = feature.getGeometry().getType() === 'Point';
    const ring = (radius, fill, stroke) => new ol.style.Circle({ radius, fill: new ol.style.Fill({ color: fill }), stroke: new ol.style.Stroke({ color: stroke, width: 2 }) });
    return isPoint ? new ol.style.Style({ image: ring(feature.get('isFault') ? 9 : 7, color, background), zIndex: 2 }) : [
      new ol.style.Style({ stroke: new ol.style.Stroke({ color: background, width: 6 }) }),
      new ol.style.Style({ stroke: new ol.style.Stroke({ color, width: 3 }), fill: new ol.style.Fill({ color: `${accent}22` }) }),
      new ol.style.Style({ image: ring(5, background, color), geometry: cornersOf }),
    ];
  }
}

function cornersOf(feature) {
  const geometry = feature.getGeometry();
  const corners = { Polygon: (rings) => rings.flat(), MultiPolygon: (polygons) => polygons.flat(2), LineString: (line) => line }[geometry.getType()]?.(geometry.getCoordinates()) ?? [];
  return new ol.geom.MultiPoint(corners);
}
