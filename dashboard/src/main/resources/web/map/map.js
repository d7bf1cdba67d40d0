/** The map with fields, devices and encounters. */
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { parameter } from '../core/router.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { CoverageDrawing } from './coverage.js';
import { DeviceDrawing } from './devices.js';
import { FarmChips } from './farm-chips.js';
import { FieldEditor } from './editor.js';
import { extentOf } from './farms.js';
import { FieldDrawing, isFound } from './fields.js';
import { legend } from './legend.js';
import { library } from './library.js';
import { readPalette } from './palette.js';
import { Pointing } from './pointing.js';
import { canvasLayer, isOnMap, project } from './projection.js';
import { clearSymbols } from './symbols.js';
import { mapTables } from './table.js';
import { BaseMap } from './tiles.js';

const OPTIONS = ['trails', 'labels', 'rows'];
/** Meters per pixel beyond which a device is too small to be seen, and the margin in which it is hardly seen, px. */
const FAR = 2;
const EDGE = 60;
const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

class FurrowMap extends Pointing(HTMLElement) {
  static observedAttributes = ['hidden'];

  connectedCallback() {
    this.options = { trails: true, labels: true, rows: true, coverage: true };
    this.fieldsVersion = 0;
    this.palette = readPalette();
    this.fields = new FieldDrawing();
    this.devices = new DeviceDrawing(this.fields);
    this.coverage = new CoverageDrawing();
    this.legend = legend((name) => this.setOption(name, !this.options[name]));
    this.tiles = new BaseMap((bounds) => this.showPlace(bounds));
    this.table = mapTables(() => this.toggleTable());
    this.editor = new FieldEditor(this);
    this.target = h('div.map-target', { tabindex: '0', role: 'application', 'aria-label': t('map.label') });
    this.tooltip = h('div.map-tooltip', { hidden: true, role: 'status' });
    this.empty = h('div.empty.map-empty', { hidden: true }, h('h2', null, t('map.emptyTitle')), h('p', null, t('map.emptyText')), h('code', null, './furrow demo'));
    this.list = h('div.map-list', { popover: 'auto' });
    this.farms = new FarmChips((field) => this.fields.extent([field]), () => { this.moved = false; this.fit(); this.kept.farm.write(); });
    replace(this, h('h1.visually-hidden', null, t('views.map')), this.target, this.farms.element, this.controls(), this.legend.element, this.tiles.attribution, this.tooltip, this.list, this.empty, this.editor.element, this.table.element);
    this.createMap();
    this.subscriptions = [...this.listen(), ...this.keepInAddress()];
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.table.close();
    this.editor.isOpen && this.editor.close();
    this.map.setTarget(null);
    this.map = null;
  }

  attributeChangedCallback() {
    if (this.map && !this.hidden) {
      this.map.updateSize();
      this.fitFirst();
      this.draw();
    }
  }

  /** Draws unless another view covers the map. */
  draw() {
    this.hidden || this.map?.render();
  }

  createMap() {
    this.view = new ol.View({ center: project(10, 50), zoom: 4, minZoom: 2, maxZoom: 23, constrainResolution: false });
    this.layers = {
      fields: canvasLayer((frame, state) => this.fields.draw(frame, state, this.palette, this.options, this.fieldsVersion), 1),
      coverage: canvasLayer((frame, state) => this.coverage.draw(frame, state, this.palette, this.options, this.fieldsVersion), 1.5),
      trails: canvasLayer((frame, state) => this.devices.drawTrails(frame, state, this.palette, this.options), 2),
      devices: canvasLayer((frame) => this.devices.draw(frame, this.palette, this.options), 3),
    };
    this.map = new ol.Map({
      target: this.target, view: this.view, controls: [], layers: [this.tiles.layer, ...Object.values(this.layers)], moveTolerance: 3,
    });
    this.map.on('moveend', () => { this.legend.scale(this.view); this.kept?.place.write(); });
    this.map.on('change:size', () => this.fitFirst());
    this.map.on('pointerdrag', () => (this.moved = true));
    this.map.on('pointermove', (event) => event.dragging || this.hover(event));
    this.map.on('click', (event) => (this.editor.isOpen ? this.editor : this).click(event));
    this.target.addEventListener('pointerleave', () => this.leave());
    this.target.addEventListener('wheel', () => (this.moved = true), { passive: true });
    this.target.addEventListener('keydown', (event) => event.key.startsWith('Arrow') && (this.moved = true));
    this.addEventListener('keydown', (event) => {
      if (this.editor.isOpen && this.table.element.hidden && !event.target.closest('dialog, input, select') && this.editor.key(event)) {
        event.preventDefault();
      } else if (event.key === 'Escape') {
        this.tooltip.hidden = true;
        this.table.element.hidden || this.toggleTable();
      }
    });
  }

  /** @returns {(function())[]} functions that unsubscribe */
  listen() {
    const draw = () => this.draw();
    const fieldsChanged = () => {
      this.fieldsVersion++;
      this.drawLegend();
      this.fitFirst();
      this.table.changed();
      draw();
    };
    const schemeChanged = () => {
      this.palette = readPalette();
      clearSymbols();
      fieldsChanged();
    };
    window.addEventListener('schemechange', schemeChanged);
    fieldsChanged();
    this.allowEditor();
    return [
      ...['encounters', 'hovered', 'filter'].map((name) => store.on(name, draw)),
      store.on('scope', () => { this.scopeChanged(); fieldsChanged(); }),
      store.on('entities', () => {
        this.fitFirst();
        store.reveal && !this.moved && this.reveal(); // of a link, once its device is known
        this.table.changed();
        this.showEmpty();
        draw();
      }),
      store.on('clock', () => { draw(); this.farms.update(); this.table.changed(); }),
      ...['fields', 'coverages'].map((name) => store.on(name, fieldsChanged)),
      store.on('mode', () => { this.classList.toggle('is-replay', store.isReplay); this.allowEditor(); draw(); }),
      store.on('me', () => this.allowEditor()),
      store.on('selection', () => { store.reveal && this.reveal(); draw(); }),
      () => window.removeEventListener('schemechange', schemeChanged),
    ];
  }

  /** @returns {(function())[]} functions that unsubscribe */
  keepInAddress() {
    this.scope = JSON.stringify(store.scope);
    this.kept = {
      farm: parameter('farm', { view: 'map', get: () => this.farms.picked, set: (key) => { this.farms.picked = key; this.moved = false; this.fitted = null; this.fitFirst(); } }),
      place: parameter('place', { view: 'map', get: () => this.place, set: (text) => this.goTo(text) }),
      table: parameter('table', { view: 'map', get: () => (this.table.element.hidden ? null : '1'), set: () => this.toggleTable() }),
    };
    return Object.values(this.kept).map(({ close }) => close);
  }

  // --- the view ----------------------------------------------------------------------------------------------------

  /** Fits the view to the farm until the user moves it. */
  fitFirst() {
    const state = `${store.fields.size} ${store.primed} ${this.map?.getSize()} ${this.farms.chosen} ${JSON.stringify(store.scope)}`;
    if (!this.hidden && !this.moved && this.fitted !== state) {
      this.fitted = state;
      this.fit(0);
    }
  }

  /** Fits another scope. A link with a scope and a place shows the place. */
  scopeChanged() {
    const scope = JSON.stringify(store.scope);
    if (scope !== this.scope) {
      this.scope = scope;
      this.farms.picked = this.farms.chosen = null;
      this.moved = false;
    }
  }

  /** Where the user moved the map, as latitude, longitude and zoom; null if it shows the farm. */
  get place() {
    const [lon, lat] = ol.proj.toLonLat(this.view.getCenter());
    return this.moved ? [lat.toFixed(5), lon.toFixed(5), this.view.getZoom().toFixed(2)].join() : null;
  }

  goTo(text) {
    const [lat, lon, zoom] = text.split(',').map(Number);
    if (isOnMap(lon, lat) && Number.isFinite(zoom)) {
      this.moved = true;
      this.view.setCenter(project(lon, lat));
      this.view.setZoom(zoom);
    }
  }

  fit(duration = 300) {
    const farm = this.farms.update();
    const extent = farm && (this.fields.extent(farm.fields) ?? extentOf(farm.devices));
    const size = this.map.getSize();
    if (extent && size) {
      const [width, height] = size;
      const narrow = width < 600;
      // the controls are on the right, the scale and the legend below, or the tools of the editor
      const below = this.editor.isOpen ? 118 : narrow ? 44 : 84;
      const padding = narrow ? [20, 60, below, 16] : [36, 72, below, 36];
      // the view learns its size after the event 'change:size'
      this.view.fit(extent, { size, padding: height < 240 ? [16, 16, this.editor.isOpen ? 92 : 16, 16] : padding, maxZoom: 20, duration: reducedMotion.matches ? 0 : duration });
      this.legend.scale(this.view);
    }
    this.kept?.place.write();
  }

  reveal() {
    const entity = store.entities.get(store.selection);
    if (entity?.position && isOnMap(...entity.position)) {
      const center = project(...entity.position);
      store.reveal = false;
      this.moved = true;
      const near = this.view.getResolution() > FAR ? { zoom: 18 } : {};
      this.view.animate({ center, ...near, duration: reducedMotion.matches ? 0 : 350 });
    }
  }

  /** Whether a device can be seen, so that the map need not move. */
  isInView({ position }) {
    if (!position || !isOnMap(...position) || this.view.getResolution() > FAR) {
      return false;
    }
    const [x, y] = this.map.getPixelFromCoordinate(project(...position)) ?? [];
    const [width, height] = this.map.getSize() ?? [];
    return x > EDGE && y > EDGE && x < width - EDGE && y < height - EDGE;
  }

  /** Moves to the first device that matches the search, else to the first field that does. */
  find() {
    const [device] = [...store.entities.values()].filter((each) => store.inScope(each) && store.matches(each)).sort((a, b) => (a.name < b.name ? -1 : 1));
    const extent = this.fields.extent([...store.fields.values()].filter(isFound).slice(0, 1));
    if (device) {
      store.select(device.id, { reveal: !this.isInView(device) });
    } else if (extent) {
      this.open(extent);
    }
  }

  zoom(by) {
    this.moved = true;
    this.view.animate({ zoom: this.view.getZoom() + by, duration: reducedMotion.matches ? 0 : 160 });
  }

  // --- controls ----------------------------------------------------------------------------------------------------

  controls() {
    const button = (symbol, words, click, attributes = {}) =>
      h('button.button.square', { type: 'button', 'aria-label': words, title: words, on: { click }, ...attributes }, icon(symbol, 18));
    const menu = h('div.map-menu', { id: 'map-layers', popover: 'auto' }, OPTIONS.map((name) => h('label.check', null,
      h('input', { type: 'checkbox', checked: true, on: { change: (event) => this.setOption(name, event.target.checked) } }), t(`map.options.${name}`))), this.tiles.element, this.legend.menu);
    this.editButton = button('pencil', t('draw.open'), () => this.toggleEditor(), { 'aria-expanded': 'false' });
    this.tableButton = button('table', t('map.table'), () => this.toggleTable(), { 'aria-expanded': 'false' });
    return h('div.map-controls', { role: 'group', 'aria-label': t('map.controls') },
      button('plus', t('map.zoomIn'), () => this.zoom(1)),
      button('minus', t('map.zoomOut'), () => this.zoom(-1)),
      button('locate', t('map.fit'), () => { this.moved = false; this.fit(); }),
      button('layers', t('map.layers'), () => {}, { popovertarget: 'map-layers' }),
      this.tableButton, this.editButton, menu);
  }

  setOption(name, on) {
    this.options[name] = on;
    this.drawLegend();
    this.draw();
  }

  drawLegend() {
    this.legend.draw(this.palette, this.options, store.coveragesInScope().some(({ layer }) => layer));
  }

  toggleTable() {
    const open = this.table.toggle();
    this.tableButton.setAttribute('aria-expanded', String(open));
    open ? this.table.element.querySelector('button')?.focus() : this.tableButton.focus();
    this.kept?.table.write();
  }

  /** Fields are drawn by operators, and not while a replay shows those of earlier. */
  allowEditor() {
    this.editButton.hidden = !store.may('operate') || store.isReplay;
    this.editButton.hidden && this.editor.isOpen && this.editor.close();
  }

  toggleEditor() {
    this.table.element.hidden || this.toggleTable();
    this.editor.toggle();
    this.classList.toggle('is-editing', this.editor.isOpen);
    this.moved || this.fit();
    this.editButton.setAttribute('aria-expanded', String(this.editor.isOpen));
  }

  editorClosed() {
    this.classList.remove('is-editing');
    this.editButton.setAttribute('aria-expanded', 'false');
    this.editButton.focus();
  }

  showEmpty() {
    this.empty.hidden = !store.primed || store.entities.size > 0 || store.isReplay;
  }
}

await library;
customElements.define('furrow-map', FurrowMap);
