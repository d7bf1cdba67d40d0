/** Offers the farms in scope if there are several, and remembers which one the map shows. */
import { h, replace } from '../core/dom.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { focusAct } from '../core/redraw.js';
import { farmsOf } from './farms.js';
import { isOnMap, project } from './projection.js';

export class FarmChips {
  /** @param {function(Object): number[]|null} boxOf a field, meters of the projection @param {function()} onChosen */
  constructor(boxOf, onChosen) {
    this.boxOf = boxOf;
    this.onChosen = onChosen;
    this.chosen = null;
    /** The farm that the user chose. */
    this.picked = null;
    this.element = h('div.chips.map-farms', { role: 'group', 'aria-label': t('map.farms') });
  }

  /** Finds the farms. The one that is shown stays as long as it exists. @returns {import('./farms.js').Farm|undefined} it */
  update() {
    const fields = store.fieldsInScope().map((field) => ({ field, box: this.boxOf(field) })).filter(({ box }) => box);
    const devices = [...store.entities.values()].filter((each) => each.position && isOnMap(...each.position) && store.inScope(each));
    const farms = farmsOf(fields, devices.map((entity) => ({ entity, point: project(...entity.position) })));
    const shown = farms.find(({ key }) => key === this.picked) ?? farms.find(({ key }) => key === this.chosen) ?? farms[0];
    if (store.primed) {
      this.chosen = shown?.key ?? null;
    }
    this.draw(farms);
    return shown;
  }

  draw(farms) {
    const drawn = JSON.stringify([this.chosen, ...farms.map(({ key, name }) => [key, name])]);
    if (drawn !== this.drawn) {
      this.drawn = drawn;
      const focused = this.element.contains(document.activeElement) ? document.activeElement.dataset.act : null;
      replace(this.element, farms.length > 1 && farms.map(({ key, name }) => h('button.chip', {
        type: 'button', data: { act: `farm ${key}` }, 'aria-pressed': String(key === this.chosen), on: { click: () => { this.picked = key; this.onChosen(); } },
      }, name)));
      focusAct(this.element, focused);
    }
  }
}
