/** Redraws content; the focus and the scroll positions of tables are retained. */
import { replace } from './dom.js';

/** Replaces content. The element with the same `data-act` as the focused one receives the focus. */
export function redraw(place, ...content) {
  const act = place.contains(document.activeElement) ? document.activeElement.dataset.act : null;
  const scrolled = [...place.querySelectorAll('.table-frame')].map((each) => [each.scrollLeft, each.scrollTop]);
  replace(place, ...content);
  place.querySelectorAll('.table-frame').forEach((each, index) => scrolled[index] && each.scrollTo(...scrolled[index]));
  focusAct(place, act);
}

export function focusAct(place, act) {
  act && place.querySelector(`[data-act="${CSS.escape(act)}"]`)?.focus({ preventScroll: true });
}
