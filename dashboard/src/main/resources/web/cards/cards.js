/** The cards of the devices: those that need attention first, then robots, cameras and all others, by name; silent ones are folded. */
import { h, isHeld, replace, setText } from '../core/dom.js';
import { shortId } from '../core/format.js';
import { icon } from '../core/icons.js';
import { parameter } from '../core/router.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { Card } from './card.js';

/** Number of cards created at once; scrolling creates more. */
const PORTION = 40;
const REDRAW_MILLIS = 250;
const ORDER_MILLIS = 1_000;
const CHIPS = [['robot', 'kinds'], ['sensor', 'kinds'], ['camera', 'kinds'], ['other', 'kinds'], ['attention', 'states'], ['stale', 'states'], ['off', 'states']];
const RANK = { attention: 0, ok: 1, stale: 2, off: 3 };
const byName = new Intl.Collator(undefined, { numeric: true, sensitivity: 'base' });

class FurrowCards extends HTMLElement {
  connectedCallback() {
    this.cards = new Map();
    this.limit = PORTION;
    this.kind = null;
    this.dirty = new Set();
    this.visible = new Set();
    this.count = h('span.numbers');
    this.chips = h('div.chips', { role: 'group', 'aria-label': t('cards.filter') });
    this.list = h('ul.card-list');
    this.fold = h('button.button.quiet.card-fold', { type: 'button', hidden: true, on: { click: () => this.toggleFold() } }, icon('chevron-down', 18), h('span'));
    this.end = h('div.card-end', { 'aria-hidden': 'true' });
    this.empty = h('div.empty', { hidden: true });
    this.unknown = h('p.small.muted', { hidden: true, role: 'status' });
    this.loading = h('div.stack', { 'aria-label': t('cards.loading'), role: 'status' }, [0, 1, 2].map(() =>
      h('div.card', null, h('div.skeleton.line', null, '…'), h('div.skeleton.block', null, '…'))));
    replace(this, h('h2.section-title', null, h('span', null, t('cards.title')), this.count), this.chips, this.unknown, this.loading, this.empty, this.list, this.fold, this.end);
    this.watcher = new IntersectionObserver((intersected) => this.intersected(intersected), { rootMargin: '200px' });
    this.watcher.observe(this.end);
    for (const event of ['wheel', 'touchmove', 'keydown', 'pointerdown']) {
      this.addEventListener(event, () => { this.following = false; }, { passive: true });
    }
    this.subscriptions = [
      store.on('entities', (ids, all) => this.changed(ids, all)),
      store.on('clock', () => this.redraw(this.visible)),
      store.on('cursor', () => this.visible.forEach((card) => card.spark.cursor())),
      store.on('selection', () => this.selected()),
      store.on('hovered', () => this.redraw(this.visible)),
      store.on('filter', () => this.order(true)),
      store.on('scope', () => this.order(true)),
      store.on('mode', () => this.redraw(this.visible)),
      store.on('suspects', () => this.redraw(this.visible)),
      store.on('images', (ids) => this.changed(ids, false)),
      store.on('me', () => this.redraw(this.visible)),
    ];
    this.kept = parameter('kind', { view: 'map', get: () => this.kind, set: (key) => CHIPS.some(([name]) => name === key) && this.choose(key) });
    this.subscriptions.push(this.kept.close);
    this.order(true);
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.watcher.disconnect();
    this.cards.forEach((card) => card.release());
    clearTimeout(this.drawing);
    clearTimeout(this.ordering);
  }

  changed(ids, all) {
    ids.forEach((id) => this.dirty.add(id));
    if (!this.drawing) {
      this.drawing = setTimeout(() => this.drawDirty(), REDRAW_MILLIS);
    }
    const isFirst = store.primed && !this.primed;
    this.primed = store.primed;
    if (all || isFirst) {
      this.order(true);
    } else if (!this.ordering) {
      // The first cards are shown sooner.
      this.ordering = setTimeout(() => { this.ordering = null; this.order(false); }, this.cards.size ? ORDER_MILLIS : REDRAW_MILLIS);
    }
  }

  drawDirty() {
    this.drawing = null;
    for (const id of this.dirty) {
      const card = this.cards.get(id);
      card && (this.visible.has(card) || card.isCommanded()) && card.draw();
    }
    this.dirty.clear();
  }

  redraw(cards) {
    cards.forEach((card) => card.draw());
  }

  /** Sorts the cards. While the pointer or focus is on the list, nothing moves: sorting waits. */
  order(now) {
    const found = this.matching();
    this.found = found.length;
    const matching = this.withCommanded(this.unfolded(found), found);
    const shown = this.withSelected(matching.slice(0, this.limit));
    if (!now && isHeld(this.list) && this.cards.size) {
      // Appended cards do not move others.
      shown.filter((each) => !this.cards.has(each.id)).forEach((each) => this.list.append(this.make(each).element));
      return this.drawCounts();
    }
    const place = this.cards.get(store.selection)?.element.getBoundingClientRect().top;
    const ids = new Set(shown.map((each) => each.id));
    for (const [id, card] of this.cards) {
      if (!ids.has(id) || store.entities.get(id) !== card.entity) {
        this.drop(id, card);
      }
    }
    let previous = null;
    for (const entity of shown) {
      const card = this.cards.get(entity.id) ?? this.make(entity);
      const place = previous ? previous.nextSibling : this.list.firstChild;
      card.element !== place && this.list.insertBefore(card.element, place);
      previous = card.element;
    }
    this.end.hidden = matching.length <= this.limit;
    this.drawCounts();
    // the selected card stays where it is
    const moved = place === undefined ? 0 : (this.cards.get(store.selection)?.element.getBoundingClientRect().top ?? place) - place;
    if (moved) {
      (this.scrollHeight > this.clientHeight ? this : this.parentElement).scrollTop += moved;
    }
    this.following && this.reveal('auto');
  }

  /** Omits devices that do not report, unless they are looked for. */
  unfolded(matching) {
    const silent = matching.filter(isSilent).length;
    const searched = store.filter.trim() !== '' || isSilent({ state: this.kind });
    this.fold.hidden = silent === 0 || searched;
    this.fold.setAttribute('aria-expanded', String(Boolean(this.unfold)));
    setText(this.fold.lastChild, t('cards.silent', { count: silent }));
    return this.unfold || searched ? matching : matching.filter((each) => !isSilent(each));
  }

  /** Adds the selected device, which is always shown. */
  withSelected(shown) {
    const selected = store.entities.get(store.selection);
    return !selected || shown.includes(selected) || !store.inScope(selected) ? shown : [...shown, selected];
  }

  /** Keeps devices with a recent command at their places, where their outcomes are read. */
  withCommanded(matching, found) {
    const kept = [...this.list.children].map(({ card }, index) => ({ entity: card.entity, index, isCommanded: card.isCommanded() }))
      .filter(({ entity, isCommanded }) => isCommanded && found.includes(entity));
    const arranged = matching.filter((each) => !kept.some(({ entity }) => entity === each));
    kept.forEach(({ entity, index }) => arranged.splice(index, 0, entity));
    return arranged;
  }

  toggleFold() {
    this.unfold = !this.unfold;
    this.order(true);
  }

  matching() {
    const found = [];
    for (const entity of store.entities.values()) {
      if (store.inScope(entity) && store.matches(entity) && (this.kind === null || entity.kind === this.kind || entity.state === this.kind)) {
        found.push(entity);
      }
    }
    const order = { robot: 0, camera: 1 };
    return found.sort((a, b) => RANK[a.state] - RANK[b.state] || (order[a.kind] ?? 2) - (order[b.kind] ?? 2) || byName.compare(a.name, b.name));
  }

  make(entity) {
    const card = new Card(entity);
    this.cards.set(entity.id, card);
    this.watcher.observe(card.element);
    card.draw();
    return card;
  }

  drop(id, card) {
    this.watcher.unobserve(card.element);
    this.visible.delete(card);
    card.release();
    card.element.remove();
    this.cards.delete(id);
  }

  intersected(entries) {
    for (const { target, isIntersecting } of entries) {
      if (target === this.end) {
        if (isIntersecting && !this.end.hidden) {
          this.limit += PORTION;
          this.order(true);
        }
      } else if (isIntersecting) {
        this.visible.add(target.card);
        target.card.draw();
      } else {
        this.visible.delete(target.card);
      }
    }
  }

  selected() {
    const id = store.selection;
    const existing = id && store.entities.get(id);
    if (existing && !this.cards.has(id)) {
      this.order(true);
    }
    this.redraw(this.visible);
    const card = this.cards.get(id);
    if (card) {
      card.draw();
      this.following = true;
      this.reveal(matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth');
    }
  }

  /** Scrolls to the selected card until the user scrolls, also when other cards are added before it. */
  reveal(behavior) {
    this.cards.get(store.selection)?.element.scrollIntoView({ block: 'nearest', behavior });
  }

  drawCounts() {
    const counts = new Map();
    let [all, reporting] = [0, 0];
    for (const entity of store.entities.values()) {
      if (store.inScope(entity)) {
        all++;
        reporting += entity.state === 'ok' || entity.state === 'attention';
        for (const key of [entity.kind, entity.state]) {
          counts.set(key, (counts.get(key) ?? 0) + 1);
        }
      }
    }
    setText(this.count, !all ? '' : store.filter || this.kind ? t('cards.found', { found: this.found, count: all }) : t('cards.count', { count: all, reporting }));
    this.loading.hidden = store.primed || all > 0;
    this.unknown.hidden = !store.pastLoaded || store.isReplay || !store.selection || store.entities.has(store.selection);
    setText(this.unknown, this.unknown.hidden ? '' : t('cards.unknown', { device: shortId(store.selection) }));
    this.drawEmpty(all);
    const chips = CHIPS.filter(([key]) => counts.get(key) || key === this.kind);
    const key = `${this.kind} ${chips.map(([name]) => `${name}${counts.get(name)}`).join()}`;
    if (key !== this.chipsKey && !isHeld(this.list)) {
      this.chipsKey = key;
      const focused = this.chips.contains(document.activeElement) ? document.activeElement.dataset.key : null;
      replace(this.chips, chips.length > 1 && chips.map(([name, section]) => h('button.chip', {
        type: 'button', data: { key: name }, 'aria-pressed': String(this.kind === name), on: { click: () => this.choose(name) },
      }, t(`${section}.${name}`), h('span.numbers', null, counts.get(name) ?? 0))));
      focused && this.chips.querySelector(`[data-key="${focused}"]`)?.focus();
    }
  }

  choose(kind) {
    this.kind = this.kind === kind ? null : kind;
    this.limit = PORTION;
    this.order(true);
    this.kept?.write();
  }

  drawEmpty(all) {
    const none = store.primed && this.cards.size === 0 && this.fold.hidden;
    this.empty.hidden = !none;
    if (none) {
      const searched = store.filter || this.kind;
      replace(this.empty, h('h3', null, t(searched && all ? 'cards.noMatch' : store.isReplay ? 'cards.noneYet' : 'cards.none')),
        h('p.small', null, t(searched && all ? 'cards.noMatchHint' : store.isReplay ? 'cards.noneYetHint' : 'cards.noneHint')));
    }
  }
}

function isSilent({ state }) {
  return state === 'stale' || state === 'off';
}

customElements.define('furrow-cards', FurrowCards);
