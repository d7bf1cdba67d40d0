/** Draws symbols of devices: the shape shows the kind and whether attention is needed, the color shows the kind. */
import { isStopped } from '../core/entity.js';

const sprites = new Map();
/** Number of directions for which an arrow is cached: rotating an image takes ten times as long as copying it. */
const DIRECTIONS = 72;

/** Half of a symbol's width, px. */
export const SIZE = { robot: 12, sensor: 8, camera: 9, other: 7, attention: 11 };

export function shapeOf(entity) {
  if (entity.state === 'attention') {
    return entity.kind === 'robot' ? 'robot' : 'attention';
  }
  return entity.kind;
}

export function clearSymbols() {
  sprites.clear();
}

/** Draws the symbol of an entity at a point. */
export function drawSymbol(context, entity, x, y, color, palette, { alpha = 1, ratio = 1 } = {}) {
  const shape = shapeOf(entity);
  const needsAttention = entity.state === 'attention';
  const hollow = entity.state === 'off' || isStopped(entity);
  const fill = needsAttention ? palette.warning : entity.state === 'stale' ? palette.muted : color;
  const turn = shape === 'robot' ? Math.round(((((entity.heading ?? 0) % 360) + 360) % 360) * DIRECTIONS / 360) % DIRECTIONS : 0;
  const image = sprite(shape, fill, palette.background, hollow, ratio, turn);
  const side = image.width / ratio;
  context.globalAlpha = alpha * (entity.state === 'stale' ? 0.55 : 1);
  // on whole pixels, so that the image is copied and not blended
  context.drawImage(image, Math.round((x - side / 2) * ratio) / ratio, Math.round((y - side / 2) * ratio) / ratio, side, side);
  if (needsAttention && shape === 'robot') {
    drawBang(context, x, y, palette);
  }
  context.globalAlpha = 1;
}

/** Draws an exclamation mark beside an arrow, which keeps its shape to show the heading. */
function drawBang(context, x, y, palette) {
  context.fillStyle = palette.warning;
  context.font = `700 13px ${palette.family}`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText('!', x + 14, y - 11);
}

function sprite(shape, fill, edge, hollow, ratio, turn) {
  const key = `${shape} ${fill} ${edge} ${hollow} ${ratio} ${turn}`;
  let canvas = sprites.get(key);
  if (!canvas) {
    canvas = document.createElement('canvas');
    canvas.width = canvas.height = Math.ceil(2 * (SIZE[shape] + 4) * ratio);
    const context = canvas.getContext('2d');
    context.translate(canvas.width / 2, canvas.height / 2);
    context.scale(ratio, ratio);
    context.rotate(turn * 2 * Math.PI / DIRECTIONS);
    trace(context, shape);
    context.lineJoin = 'round';
    context.lineWidth = 4;
    context.strokeStyle = edge;
    context.stroke();
    if (hollow) {
      context.fillStyle = edge;
      context.fill();
      context.lineWidth = 2;
      context.strokeStyle = fill;
      context.stroke();
    } else {
      context.fillStyle = fill;
      context.fill();
    }
    sprites.set(key, canvas);
  }
  return canvas;
}

/** Traces a shape around 0,0; an arrow points up. */
export function trace(context, shape, scale = 1) {
  const s = SIZE[shape] * scale;
  context.beginPath();
  if (shape === 'robot') {
    context.moveTo(0, -s);
    context.lineTo(s * 0.78, s * 0.9);
    context.lineTo(0, s * 0.48);
    context.lineTo(-s * 0.78, s * 0.9);
  } else if (shape === 'attention') {
    context.moveTo(0, -s * 0.95);
    context.lineTo(s, s * 0.8);
    context.lineTo(-s, s * 0.8);
  } else if (shape === 'camera') {
    context.roundRect(-s, -s * 0.72, 2 * s, s * 1.44, 2.5);
  } else if (shape === 'other') {
    context.moveTo(0, -s);
    context.lineTo(s, 0);
    context.lineTo(0, s);
    context.lineTo(-s, 0);
  } else {
    context.arc(0, 0, s, 0, 2 * Math.PI);
  }
  context.closePath();
}
