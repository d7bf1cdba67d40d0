/** Reads the design tokens' colors for drawing on canvases. */

const NAMES = [
  'background', 'panel', 'raised', 'line', 'text', 'muted', 'accent', 'live', 'replay', 'warning', 'critical', 'on-critical', 'information',
  'field', 'field-row', 'field-border', 'kind-robot', 'kind-robot-2', 'kind-sensor', 'kind-camera', 'kind-other', 'worked', 'worked-again', 'gap',
];

/** @returns {Object<string, string>} colors by the token's name */
export function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const palette = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  palette.family = style.getPropertyValue('--family').trim();
  palette.label = style.getPropertyValue('--font-label').trim();
  return palette;
}

/** The color of an entity. Robots have different colors, so that their trails can be distinguished; others have the color of their kind. */
export function colorOf(entity, palette) {
  if (entity.kind === 'robot') {
    return hash(entity.id) % 2 === 0 ? palette['kind-robot'] : palette['kind-robot-2'];
  }
  return palette[`kind-${entity.kind}`] ?? palette['kind-other'];
}

function hash(text) {
  let sum = 0;
  for (let i = 0; i < text.length; i++) {
    sum = (sum * 31 + text.charCodeAt(i)) | 0;
  }
  return Math.abs(sum);
}
