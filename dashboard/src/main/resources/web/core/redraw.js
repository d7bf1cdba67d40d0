/** Redraws content; the focus and the scroll positions of tables are retained. */
import { replace } from './dom.js';

const RETRY_MILLIS = 50;
const delayed = new WeakMap();

/**
 * Replaces content, once nothing in it is pressed: a click misses what is replaced before the pointer is released. The element with the same
 * `data-act` as the focused one receives the focus.
 */
export function redraw(place, ...content) {
  clearTimeout(delayed.get(place));
  if (place.matches(':active')) {
    delayed.set(place, setTimeout(() => redraw(place, ...content), RETRY_MILLIS));
    return;
  }
  const act = place.contains(document.activeElement) ? document.activeElement.dataset.act : null;
  const scrolled = [...place.querySelectorAll('.table-frame')].map((each) => [each.scrollLeft, each.scrollTop]);
  replace(place, ...content);
  place.querySelectorAll('.table-frame').forEach((each, index) => scrolled[index] && each.scrollTo(...scrolled[index]));
  focusAct(place, act);
}

export function focusAct(place, act) {
  act && place.querySelector(`[data-act="${CSS.escape(act)}"]`)?.focus({ preventScroll: true });
}
