/** Projects to Web Mercator, and from there to pixels of a frame. */

const RADIUS = 6_378_137;
const LIMIT = 85.05;

/** Whether a position can be drawn: Web Mercator ends before the poles. */
export function isOnMap(lon, lat) {
  return Number.isFinite(lon) && Number.isFinite(lat) && Math.abs(lon) <= 180 && Math.abs(lat) <= LIMIT;
}

/** @returns {[number, number]} meters of EPSG:3857 */
export function project(lon, lat) {
  const bounded = Math.max(-LIMIT, Math.min(LIMIT, lat));
  return [RADIUS * lon * Math.PI / 180, RADIUS * Math.log(Math.tan(Math.PI / 4 + bounded * Math.PI / 360))];
}

/** Projects a point of a trail, which caches the result. @param {import('../core/line.js').Line} trail */
export function projectPoint(trail, index) {
  if (Number.isNaN(trail.x[index])) {
    [trail.x[index], trail.y[index]] = project(trail.lon[index], trail.lat[index]);
  }
}

/** Meters on the ground per meter of the projection. */
export function groundScale(lat) {
  return Math.cos(lat * Math.PI / 180);
}

/**
 * Resizes a canvas to the map, and returns how coordinates are converted to its pixels.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {Object} frameState of OpenLayers
 */
function frameOf(canvas, frameState) {
  const ratio = frameState.pixelRatio;
  const [width, height] = frameState.size;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
  }
  const [a, b, c, d, e, f] = frameState.coordinateToPixelTransform;
  return {
    context: canvas.getContext('2d'), ratio, width, height, resolution: frameState.viewState.resolution, rotation: frameState.viewState.rotation,
    x: (x, y) => a * x + c * y + e,
    y: (x, y) => b * x + d * y + f,
  };
}

/** Creates a layer with its own canvas, drawn by a function. */
export function canvasLayer(draw, zIndex) {
  const canvas = document.createElement('canvas');
  canvas.className = 'map-canvas';
  return new ol.layer.Layer({
    zIndex,
    source: new ol.source.Source({}),
    render: (frameState) => {
      draw(frameOf(canvas, frameState), frameState);
      return canvas;
    },
  });
}
