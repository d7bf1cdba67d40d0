/** Creates DOM elements. Texts become text nodes, never markup. */

const SVG = 'http://www.w3.org/2000/svg';
const PROPERTIES = new Set(['value', 'checked', 'disabled', 'hidden', 'indeterminate', 'selected']);

/**
 * Creates an element.
 *
 * @param {string} tag `name`, `name.class.class` or `svg:name`
 * @param {Object=} props `on: {event: handler}`, `data: {name: value}`, properties and attributes; null and false are omitted
 * @param {...(Node
 * string
 * number
 * Array
 * null
 * false)} children
 * @returns {Element}
 */
export function h(tag, props, ...children) {
  const [name, ...classes] = tag.split('.');
  const element = name.startsWith('svg:')
    ? document.createElementNS(SVG, name.slice(4))
    : document.createElement(name || 'div');
  if (classes.length) {
    element.setAttribute('class', classes.join(' '));
  }
  for (const [key, value] of Object.entries(props ?? {})) {
    set(element, key, value);
  }
  append(element, children);
  return element;
}

function set(element, key, value) {
  if (key === 'on') {
    Object.entries(value).forEach(([event, handler]) => element.addEventListener(event, handler));
  } else if (key === 'data') {
    Object.assign(element.dataset, value);
  } else if (key === 'class') {
    value && element.classList.add(...value.split(' ').filter(Boolean));
  } else if (PROPERTIES.has(key) && key in element) {
    element[key] = value ?? '';
  } else if (value === true) {
    element.setAttribute(key, '');
  } else if (value !== false && value !== null && value !== undefined) {
    element.setAttribute(key, value);
  }
}

function append(element, children) {
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined && child !== false) {
      element.append(child instanceof Node ? child : String(child));
    }
  }
}

/** Replaces all children of an element. */
export function replace(element, ...children) {
  element.replaceChildren();
  append(element, children);
  return element;
}

/** Whether the pointer, or the keyboard's focus, is on an element: then nothing in it moves by itself. */
export function isHeld(element) {
  return element.matches(':hover, :has(:focus-visible)');
}

/** Sets a text only if it differs, to avoid needless layout. */
export function setText(element, text) {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}
