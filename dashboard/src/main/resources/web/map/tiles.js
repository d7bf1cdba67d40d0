/** The base map below the fields: of the server's file or address, or a PMTiles file that the user chose, or none. */
import { h, replace } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { removeFile, storedFile, storeFile } from '../core/stored-file.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { PmtilesFile } from './pmtiles.js';

/** The class of the layer, which the style sheet mutes. */
const CLASS = 'map-tiles';
/** The choice in this browser: `none`, `server`, `address` or `own`. */
const CHOICE = 'furrow-base-map';
const OWN = 'base-map';

export class BaseMap {
  /** @param {function(number[])} show shows the place of a file that was just chosen: west, south, east, north */
  constructor(show) {
    this.show = show;
    this.attribution = h('p.map-attribution', { hidden: true });
    this.layer = new ol.layer.Tile({ className: CLASS, zIndex: 0 });
    this.failure = h('p.small.bad', { role: 'alert' });
    this.choices = h('div');
    this.input = h('input.visually-hidden', { type: 'file', accept: '.pmtiles', tabindex: '-1', 'aria-label': t('map.base.file'), on: { change: () => this.chosenFile() } });
    this.element = h('fieldset.base-map', null, h('legend', null, t('map.base.title')), this.choices,
      h('button.button.small', { type: 'button', on: { click: () => this.input.click() } }, icon('upload', 16), t('map.base.file')), this.input,
      h('p.small.muted', null, t('map.base.hint')), this.failure);
    this.restore();
  }

  /** What can be chosen; of what the server offers, the first is shown until the user chooses. */
  get offered() {
    const { tiles, tileFile } = store.config;
    return [tileFile && 'server', tiles && 'address', 'none', this.own && 'own'].filter(Boolean);
  }

  async restore() {
    const choice = localStorage.getItem(CHOICE);
    try {
      this.own = await storedFile(OWN);
    } catch (error) {
      console.warn('the base map cannot be read from this browser:', error.message); // as in a private window
    }
    this.use(choice);
  }

  /** @param {string|null} choice */
  async use(choice) {
    this.choice = this.offered.includes(choice) ? choice : this.offered[0];
    this.attribution.hidden = true;
    this.layer.setSource(null);
    this.draw();
    const chosen = this.choice;
    try {
      const source = await this.sourceOf(chosen);
      chosen === this.choice && this.layer.setSource(source);
    } catch (error) {
      this.failure.textContent = t('map.base.failed', { reason: error.message });
    }
  }

  sourceOf(choice) {
    const { tiles: url, tileFile } = store.config;
    return { none: () => null, own: () => this.fileSource(this.own), server: () => this.fileSource(tileFile), address: () => new ol.source.XYZ({ url }) }[choice]();
  }

  choose(choice) {
    localStorage.setItem(CHOICE, choice);
    this.failure.textContent = '';
    this.use(choice);
  }

  /** Stores the file that was chosen, if it has pictures. */
  async chosenFile() {
    const [file] = this.input.files;
    this.input.value = '';
    if (!file) {
      return;
    }
    try {
      const { type, bounds } = await new PmtilesFile(file).header();
      if (!type) {
        throw new Error(t('map.base.noPictures', { file: file.name }));
      }
      await storeFile(OWN, file);
      this.own = file;
      this.choose('own');
      this.show(bounds);
    } catch (error) {
      this.failure.textContent = t('map.base.failed', { reason: error.message });
    }
  }

  async remove() {
    await removeFile(OWN);
    this.own = null;
    this.choose(this.choice === 'own' ? 'none' : this.choice);
  }

  draw() {
    const isFocused = this.choices.contains(document.activeElement);
    const names = { none: t('map.base.none'), server: t('map.base.server'), address: t('map.base.address', { host: hostOf(store.config.tiles) }), own: this.own?.name };
    replace(this.choices, this.offered.map((each) => h('div.row', null,
      h('label.check', null, h('input', { type: 'radio', name: 'base-map', value: each, checked: each === this.choice, on: { change: () => this.choose(each) } }),
        h('span.cut', null, names[each])),
      each === 'own' && h('button.button.quiet.square.small', { type: 'button', 'aria-label': t('map.base.remove', { file: this.own.name }), title: t('map.base.remove', { file: this.own.name }), on: { click: () => this.remove() } }, icon('trash', 16)))));
    isFocused && this.choices.querySelector('input:checked').focus();
  }

  async fileSource(place) {
    const file = new PmtilesFile(place);
    const { minZoom, maxZoom } = await file.header();
    const { choice } = this;
    file.metadata().then(({ attribution }) => choice === this.choice && this.attribute(attribution), (error) => console.warn('map tiles:', error.message));
    const nothing = document.createElement('canvas');
    return new ol.source.ImageTile({
      minZoom, maxZoom, transition: 0,
      loader: async (z, x, y, { signal }) => {
        const picture = await file.tile(z, x, y, signal);
        return picture ? createImageBitmap(picture) : nothing;
      },
    });
  }

  /** Shows the attribution as text; files contain it as markup. */
  attribute(markup) {
    if (typeof markup === 'string' && markup) {
      this.attribution.textContent = new DOMParser().parseFromString(markup, 'text/html').body.textContent;
      this.attribution.hidden = false;
    }
  }
}

function hostOf(url) {
  return new URL(url ?? '', location.href).host;
}
