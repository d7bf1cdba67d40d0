/** Follows the pointer on the map: names what is under it, selects it by a click, and opens clusters. */
import { age } from '../core/format.js';
import { h, replace } from '../core/dom.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { CELL } from './clusters.js';
import { project } from './projection.js';

/** Maximum zoom when opening a cluster. */
const MAX_CLUSTER_ZOOM = 22;
const MAX_LISTED = 100;
const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

/** @template T @param {T} Base @returns {T} with handlers of the pointer */
export const Pointing = (Base) => class extends Base {
  hover(event) {
    if (this.editor.isOpen) {
      return;
    }
    const found = this.devices.at(...event.pixel);
    this.target.style.cursor = found ? 'pointer' : '';
    store.setHovered(found?.entity?.id ?? null);
    this.tooltip.hidden = !found;
    if (found) {
      replace(this.tooltip, found.entity ? tooltipOf(found.entity) : t('map.cluster', { count: found.count }));
      const right = found.x > this.clientWidth - 220;
      this.tooltip.style.transform = `translate(${Math.round(found.x + (right ? -18 : 18))}px, ${Math.round(found.y + 14)}px)${right ? ' translateX(-100%)' : ''}`;
    }
  }

  leave() {
    store.setHovered(null);
    this.tooltip.hidden = true;
  }

  click(event) {
    const found = this.devices.at(...event.pixel);
    if (found?.entity) {
      store.select(found.entity.id);
    } else if (found) {
      const extent = ol.extent.boundingExtent(found.spots.map((each) => each.entity.xy));
      const spread = Math.max(ol.extent.getWidth(extent), ol.extent.getHeight(extent));
      spread / this.view.getResolutionForZoom(MAX_CLUSTER_ZOOM) < CELL ? this.openList(found) : this.open(extent);
    } else {
      store.select(null);
    }
  }

  open(extent) {
    this.moved = true;
    this.view.fit(ol.extent.buffer(extent, 5), { padding: [80, 80, 80, 80], maxZoom: MAX_CLUSTER_ZOOM, duration: reducedMotion.matches ? 0 : 300 });
  }

  /** Moves to a place, unless a part of it is in view. @param {number[]} bounds west, south, east, north */
  showPlace([west, south, east, north]) {
    const extent = [...project(west, south), ...project(east, north)];
    ol.extent.intersects(extent, this.view.calculateExtent(this.map.getSize())) || this.open(extent);
  }

  /** The user works on what the map shows: it is not fitted any more. */
  worked() {
    this.moved = true;
  }

  /** Lists devices that cannot be distinguished at any zoom. */
  openList({ x, y, spots }) {
    const names = spots.map(({ entity }) => entity).sort((a, b) => (a.name < b.name ? -1 : 1)).slice(0, MAX_LISTED);
    replace(this.list,
      h('p.small.muted', null, t('map.oneSpot', { count: spots.length })),
      h('ul', null, names.map((entity) => h('li', null, h('button.button.quiet', {
        type: 'button', on: { click: () => { this.list.hidePopover(); store.select(entity.id, { reveal: false }); } },
      }, h('span', null, entity.name), h('span.small.muted', null, t(`states.${entity.state}`)))))));
    const box = this.getBoundingClientRect();
    this.list.style.left = `${Math.max(8, Math.min(box.left + x + 12, innerWidth - 268))}px`;
    this.list.style.top = `${Math.max(8, Math.min(box.top + y + 12, innerHeight - 328))}px`;
    // waits for the end of the click, which would close the list
    setTimeout(() => {
      this.list.showPopover();
      this.list.querySelector('button').focus();
    });
  }
};

function tooltipOf(entity) {
  return [h('strong', null, entity.name), h('span.muted', null, `${t(`kinds.${entity.kind}`)} · ${t(`states.${entity.state}`)} · ${age(store.now() - entity.time)}`)];
}
