/** Finds positions for texts so that they cover neither symbols nor each other. */

const LINE = 15;

export class LabelPlaces {
  constructor() {
    this.cells = new Map();
  }

  /** Reserves a box that no text may cover. */
  block(left, top, right, bottom) {
    this.each(left, top, right, bottom, (key) => {
      const boxes = this.cells.get(key) ?? [];
      boxes.push([left, top, right, bottom]);
      this.cells.set(key, boxes);
      return false;
    });
  }

  isFree(left, top, right, bottom) {
    return !this.each(left, top, right, bottom, (key) =>
      this.cells.get(key)?.some((box) => left < box[2] && right > box[0] && top < box[3] && bottom > box[1]));
  }

  each(left, top, right, bottom, visit) {
    for (let x = Math.floor(left / 64); x <= Math.floor(right / 64); x++) {
      for (let y = Math.floor(top / 64); y <= Math.floor(bottom / 64); y++) {
        if (visit(x * 100_003 + y)) {
          return true;
        }
      }
    }
    return false;
  }

  /**
   * Finds a position for a text right, left, below or above a symbol.
   *
   * @returns {{x: number, y: number}|null} the left end of its middle line
   */
  beside(x, y, half, width, frameWidth) {
    const gap = half + 6;
    const tries = [[x + gap, y], [x - gap - width, y], [x - width / 2, y + gap + LINE / 2], [x - width / 2, y - gap - LINE / 2]];
    for (const [left, middle] of tries) {
      const box = [left - 2, middle - LINE / 2, left + width + 2, middle + LINE / 2];
      if (box[0] >= 0 && box[2] <= frameWidth && this.isFree(...box)) {
        this.block(...box);
        return { x: left, y: middle };
      }
    }
    return null;
  }
}

const widths = new Map();

/** The width of a text, cached because it is the same in every frame. */
export function widthOf(context, text) {
  const key = `${context.font}|${text}`;
  let width = widths.get(key);
  if (width === undefined) {
    width = context.measureText(text).width;
    widths.size > 5_000 && widths.clear();
    widths.set(key, width);
  }
  return width;
}

/** Draws a text with an outline in the background color, readable on anything. */
export function drawText(context, text, x, y, color, edge) {
  context.textAlign = 'left';
  context.textBaseline = 'middle';
  context.lineJoin = 'round';
  context.lineWidth = 3;
  context.strokeStyle = edge;
  context.strokeText(text, x, y);
  context.fillStyle = color;
  context.fillText(text, x, y);
}
