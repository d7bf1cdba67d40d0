/** Draws what robots have worked of fields, cell by cell. */
import { visitRuns } from '../core/coverage.js';
import { store } from '../core/store.js';
import { project } from './projection.js';

/** Colors of cells by their code: covered, covered again, gap. */
export const CELL_COLORS = [null, 'worked', 'worked-again', 'gap'];
const ALPHA = 0.55;

export class CoverageDrawing {
  constructor() {
    this.images = new WeakMap();
    this.key = null;
  }

  /** Redraws only if the coverages or the view changed. */
  draw(frame, frameState, palette, options, version) {
    const key = `${frameState.coordinateToPixelTransform.join()} ${frame.width} ${frame.height} ${frame.ratio} ${version} ${options.coverage}`;
    if (key === this.key) {
      return;
    }
    this.key = key;
    const { context, ratio } = frame;
    context.resetTransform();
    context.clearRect(0, 0, frame.width * ratio, frame.height * ratio);
    for (const { layer } of options.coverage ? store.coveragesInScope() : []) {
      layer && this.drawLayer(frame, layer, palette);
    }
    context.resetTransform();
  }

  /** A field is so small that its degrees are straight and even in the projection, which may be turned. */
  drawLayer(frame, layer, palette) {
    const { context, ratio } = frame;
    const [west, south, east, north] = layer.box;
    const [origin, right, down] = [[west, north], [east, north], [west, south]].map(([lon, lat]) => project(lon, lat)).map(([x, y]) => [frame.x(x, y) * ratio, frame.y(x, y) * ratio]);
    const per = (corner, count) => [(corner[0] - origin[0]) / count, (corner[1] - origin[1]) / count];
    const [perColumn, perRow] = [per(right, layer.columns), per(down, layer.rows)];
    context.setTransform(...perColumn, ...perRow, ...origin);
    context.imageSmoothingEnabled = Math.hypot(...perColumn) < 2;
    context.drawImage(this.imageOf(layer, palette), 0, 0);
  }

  /** One pixel per cell, drawn once per layer and color scheme. */
  imageOf(layer, palette) {
    const known = this.images.get(layer);
    if (known?.palette === palette) {
      return known.image;
    }
    const image = Object.assign(document.createElement('canvas'), { width: layer.columns, height: layer.rows });
    const context = image.getContext('2d');
    context.globalAlpha = ALPHA;
    visitRuns(layer, (code, row, column, length) => {
      context.fillStyle = palette[CELL_COLORS[code]];
      context.fillRect(column, layer.rows - 1 - row, length, 1);
    });
    this.images.set(layer, { palette, image });
    return image;
  }
}
