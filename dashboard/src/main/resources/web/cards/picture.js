/** The newest stored image of a camera. */
import { api } from '../core/api.js';
import { age } from '../core/format.js';
import { h, setText } from '../core/dom.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';

/** Time after which a picture that could not be loaded now is requested again. */
const RETRY_MILLIS = 2000;

export class Picture {
  constructor() {
    this.image = h('img', { alt: '', hidden: true, decoding: 'async' });
    this.caption = h('figcaption.small.muted');
    this.element = h('figure.picture', { hidden: true }, this.image, this.caption);
  }

  /** @param {import('../core/entity.js').Entity} entity */
  async draw(entity) {
    const stored = store.imageOf(entity);
    this.element.hidden = !stored && entity.kind !== 'camera';
    if (!stored) {
      setText(this.caption, t('cards.noPicture'));
      return;
    }
    if (this.shown !== stored.sha256 && !this.loading && !(this.failed === stored.sha256 && Date.now() < this.retryAt)) {
      await this.load(stored, entity);
    }
    if (this.takenAt) {
      setText(this.caption, t('cards.pictureOf', { age: age(store.now() - this.takenAt) }));
    }
  }

  async load(stored, entity) {
    this.loading = true;
    this.shown = stored.sha256;
    try {
      const response = await api.fetch(`/api/images/${encodeURIComponent(stored.sha256)}`);
      const url = URL.createObjectURL(await response.blob());
      this.release();
      this.url = url;
      this.image.src = url;
      this.image.alt = t('cards.pictureAlt', { name: entity.name });
      this.image.hidden = false;
      this.takenAt = stored.time;
    } catch (error) {
      this.takenAt = null;
      this.image.hidden = true;
      setText(this.caption, t('cards.pictureFailed', { reason: error.message }));
      if (error.status === 0 || error.status === 503) {
        this.shown = null;
        this.failed = stored.sha256;
        this.retryAt = Date.now() + RETRY_MILLIS;
      }
    } finally {
      this.loading = false;
    }
  }

  release() {
    this.url && URL.revokeObjectURL(this.url);
    this.url = null;
  }
}
