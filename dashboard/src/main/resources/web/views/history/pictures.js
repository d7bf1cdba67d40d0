/** Shows the stored pictures of a period, one at a time, in the order of their times. */
import { api } from '../../core/api.js';
import { h, replace, setText } from '../../core/dom.js';
import { dateTime, shortId } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { isIn, scopeOf } from '../../core/identities.js';
import { store } from '../../core/store.js';
import { historyIfAny } from '../../timeline/moments.js';
import { t } from '../../texts.js';
import { PeriodPanel } from './period-panel.js';

const TOPIC = 'data.images';

export class Pictures extends PeriodPanel {
  /** @param {function()} changed is called when another picture is shown */
  constructor(changed) {
    super();
    this.changed = changed;
    /** Time of the picture that is shown, or of the one to be shown, epoch ms; null for the newest. */
    this.at = null;
    this.found = [];
    this.count = h('span.numbers.muted');
    this.image = h('img', { alt: '', decoding: 'async', hidden: true });
    this.failed = h('p.error-note', { role: 'alert', hidden: true });
    this.caption = h('figcaption.numbers', { 'aria-live': 'polite' });
    this.previous = this.button('chevron-left', 'previous', -1);
    this.next = this.button('chevron-right', 'next', 1);
    this.position = h('input', { type: 'range', min: 0, step: 1, 'aria-label': t('history.picture'), on: { input: () => this.go(Number(this.position.value)) } });
    this.viewer = h('div.stack', null, h('div.row', null, this.previous, this.position, this.next), h('figure.history-picture', null, this.caption, this.failed, this.image));
    this.element = h('section.panel.stack.analysis.history-pictures', { 'aria-label': t('history.pictures'), on: { keydown: (event) => this.key(event) } },
      h('div.row', null, h('h2', null, t('history.pictures')), h('span.spacer'), this.count), this.content, this.notes);
  }

  button(symbol, words, step) {
    return h('button.button.square', { type: 'button', 'aria-label': t(`history.${words}`), title: t(`history.${words}`), on: { click: () => this.go(this.index + step) } }, icon(symbol));
  }

  /** @param {{entity: import('../../core/entity.js').Entity|null, range: function(): [number, number], interval: number}} request `entity`: null for all cameras */
  read({ range }) {
    const [from, to] = range();
    return historyIfAny(TOPIC, { from: Math.floor(from), to: Math.ceil(to) }).then((answer) => ({ from, to, ...answer }));
  }

  release() {
    this.close();
    this.abort?.abort();
    this.url && URL.revokeObjectURL(this.url);
  }

  show() {
    const { value } = this.history;
    this.found = (value?.records ?? []).filter((record) => typeof record.value?.sha256 === 'string' && this.isShown(record)).sort((one, other) => one.time - other.time);
    const { found } = this;
    setText(this.count, found.length ? t('history.pictureCount', { count: found.length }) : '');
    this.showNotes(found.length > 0);
    if (found.length) {
      this.put('viewer', this.viewer);
      this.position.max = found.length - 1;
      const at = this.at === null ? found.length - 1 : nearest(found, this.at);
      this.go(at, false);
    } else {
      this.showNothing('noPictures');
    }
  }

  /** Images of an older job lack the type. */
  isShown({ value, headers }) {
    const identity = this.request.entity?.identity;
    return !identity || (value.entity === identity.id && (!value.type || value.type === identity.type) && isIn(identity, scopeOf(headers)));
  }

  /** Shows a picture. @param {boolean=} chosen whether the user chose it */
  go(index, chosen = true) {
    const record = this.found[index];
    if (!record) {
      return;
    }
    this.index = index;
    const focused = document.activeElement;
    this.previous.disabled = index === 0;
    this.next.disabled = index === this.found.length - 1;
    focused.disabled && this.position.focus(); // else the keys lead nowhere
    this.position.value = index;
    const { entity } = record.value;
    const name = store.entities.get(store.keysOf(record, [entity], [record.value.type])[0])?.name ?? shortId(entity);
    const words = t('history.pictureAt', { name, time: dateTime(record.time), number: index + 1, count: this.found.length });
    this.position.setAttribute('aria-valuetext', words);
    setText(this.caption, words);
    if (chosen) {
      this.at = index === this.found.length - 1 ? null : record.time;
      store.setCursor(record.time);
      this.changed();
    }
    record.value.sha256 === this.sha256 || this.loadImage(record.value.sha256);
    this.image.alt = words;
  }

  async loadImage(sha256) {
    this.abort?.abort();
    const abort = (this.abort = new AbortController());
    this.sha256 = sha256;
    try {
      const response = await api.fetch(`/api/images/${encodeURIComponent(sha256)}`, { signal: abort.signal });
      const url = URL.createObjectURL(await response.blob());
      if (abort.signal.aborted) {
        return URL.revokeObjectURL(url);
      }
      this.url && URL.revokeObjectURL(this.url);
      this.url = url;
      this.image.src = url;
      this.image.hidden = false;
      this.failed.hidden = true;
    } catch (error) {
      if (!abort.signal.aborted) {
        this.sha256 = null;
        this.image.hidden = true;
        this.failed.hidden = false;
        replace(this.failed, icon('warning', 18), t('cards.pictureFailed', { reason: error.message }));
      }
    }
  }

  key(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step && event.target !== this.position && this.found.length) {
      event.preventDefault();
      this.go(this.index + step);
    }
  }
}

function nearest(found, time) {
  return found.reduce((best, each, index) => (Math.abs(each.time - time) < Math.abs(found[best].time - time) ? index : best), 0);
}
