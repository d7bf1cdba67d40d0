/** Maps keys to actions of the timeline, wherever the focus is. */

const TYPING = 'input, textarea, select, [contenteditable], dialog';
/** Elements that use some keys themselves. */
const PRESSED = 'button, a, summary, [role="button"], [role="menuitemradio"], [role="tab"]';
const MOVED = 'furrow-map, [role="listbox"], [role="grid"], [role="tablist"], [role="menu"], .table-frame';

/**
 * The action of a key.
 *
 * @param {KeyboardEvent} event
 * @param {Element} timeline
 * @returns {string|null} null if the key is not for the timeline
 */
export function keyOf(event, timeline) {
  const target = event.target instanceof Element ? event.target : document.body;
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]') || timeline.closest('[hidden]')) {
    return null;
  }
  const within = timeline.contains(target);
  if (target.closest(TYPING)) {
    return null;
  }
  switch (event.key) {
    case ' ': return target.closest(PRESSED) ? null : 'toggle';
    case 'ArrowLeft': return !within && target.closest(MOVED) ? null : event.shiftKey ? 'jumpBack' : 'back';
    case 'ArrowRight': return !within && target.closest(MOVED) ? null : event.shiftKey ? 'jumpForward' : 'forward';
    case 'Home': return within ? 'start' : null;
    case 'End': return within ? 'end' : null;
    case '[': return 'loopFrom';
    case ']': return 'loopTo';
    case 'm': return 'mark';
    case '+': return within ? 'zoomIn' : null;
    case '-': return within ? 'zoomOut' : null;
    case 'Escape': return within ? 'leave' : null;
    default: return null;
  }
}
