/** Replaces what a place holds; focus, and how far its tables are scrolled, stay. */
import { replace } from '../../core/dom.js';

/** What takes the focus again has `data-act`, one of its kind in the place. */
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
