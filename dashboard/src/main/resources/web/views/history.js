/** Shows attributes of a device over hours and days, and the pictures of a camera: live, or of the recording that a replay plays. */
import { CONTEXT, keyAttributes } from '../cards/attributes.js';
import { deviceAt } from '../cards/commands.js';
import { h, replace, setText } from '../core/dom.js';
import { label, shortId, zone } from '../core/format.js';
import { icon } from '../core/icons.js';
import { TimeInput, timeElement } from '../core/local-time.js';
import { parameter } from '../core/router.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { AttributePanel } from './history/panel.js';
import { Pictures } from './history/pictures.js';

const MINUTE = 60_000;
const HOUR = 60 * MINUTE;
const PERIODS = [HOUR, 6 * HOUR, 24 * HOUR, 7 * 24 * HOUR];
/** Of a period that ends now: parts after each of which it is read again. */
const REFRESHES = 120;
const MIN_INTERVAL = 30_000;
const MAX_ATTRIBUTES = 200;

class History extends HTMLElement {
  connectedCallback() {
    this.period = PERIODS[0];
    this.own = null;
    this.chosen = [null, null];
    this.ofAll = false;
    this.panels = [1, 2].map((place) => new AttributePanel(place, () => this.kept[place === 1 ? 'limit' : 'limit2'].write()));
    this.pictures = new Pictures(() => this.kept.picture.write());
    this.build();
    const threshold = (panel) => ({ view: 'history', get: () => panel.threshold.value, set: (value) => { panel.threshold.value = value; } });
    const attribute = (index) => ({ view: 'history', get: () => this.chosen[index], set: (name) => this.choose(index, name) });
    this.kept = {
      attribute: parameter('attribute', attribute(0)),
      second: parameter('second', attribute(1)),
      period: parameter('period', { view: 'history', get: () => (this.own || this.period === PERIODS[0] ? null : String(this.period / MINUTE)), set: (minutes) => this.choosePeriod(Number(minutes) * MINUTE) }),
      own: parameter('between', { view: 'history', get: () => this.own?.join('~'), set: (text) => this.chooseOwn(...text.split('~').map(Number)) }),
      limit: parameter('threshold', threshold(this.panels[0])),
      limit2: parameter('threshold2', threshold(this.panels[1])),
      pictures: parameter('pictures', { view: 'history', get: () => (this.ofAll ? 'all' : null), set: (text) => this.chooseAll(text === 'all') }),
      picture: parameter('picture', { view: 'history', get: () => this.pictures.at && String(this.pictures.at), set: (time) => { this.pictures.at = Number(time) || null; } }),
    };
    this.subscriptions = [
      store.on('selection', () => this.load()), store.on('mode', () => this.load()), store.on('entities', () => this.schedule()),
      ...Object.values(this.kept).map(({ close }) => close),
    ];
    this.load();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    clearTimeout(this.timer);
    [...this.panels, this.pictures].forEach((each) => each.release());
  }

  build() {
    this.subtitle = h('p.muted');
    this.device = h('select', { id: 'history-device', on: { change: () => this.chooseDevice(this.device.value || null) } });
    this.selects = [0, 1].map((index) => h('select', { id: `history-attribute-${index}`, on: { change: (event) => this.choose(index, event.target.value || null) } }));
    this.periods = h('div.segments', { role: 'group', 'aria-label': t('analyses.period') }, PERIODS.map((period) => h('button.button.small', {
      type: 'button', data: { period }, on: { click: () => this.choosePeriod(period) },
    }, period === HOUR ? t('history.hour') : period <= 24 * HOUR ? t('analyses.hours', { hours: period / HOUR }) : t('history.days', { days: period / 24 / HOUR }))),
    h('button.button.small', { type: 'button', data: { period: 'mission' }, on: { click: () => this.setOwn(null) } }, t('analyses.mission')),
    h('button.button.small', { type: 'button', data: { period: 'own' }, 'aria-expanded': 'false', 'aria-controls': 'history-own', on: { click: () => this.toggleForm() } }, t('history.own')));
    this.from = new TimeInput(timeElement({ id: 'history-from' }), false);
    this.to = new TimeInput(timeElement({ id: 'history-to' }), true);
    this.wrong = h('p.small.failed', { role: 'alert' });
    this.form = h('form.row.wrap.history-own', { id: 'history-own', hidden: true, on: { submit: (event) => this.submit(event) } },
      [['from', this.from], ['to', this.to]].map(([name, { element }]) => h('div.field-row', null, h('label', { for: element.id }, t(`replays.${name}`, { zone: zone(Date.now()) })), element)),
      h('button.button.small', { type: 'submit' }, t('history.show')), this.wrong);
    this.all = h('button.button.small', { type: 'button', 'aria-pressed': 'false', on: { click: () => this.chooseAll(!this.ofAll) } }, icon('camera', 16), t('history.allPictures'));
    this.none = h('div.empty', { hidden: true });
    this.charts = h('div.history-charts', null, h('div.skeleton.analysis-skeleton', { 'aria-busy': 'true' }));
    this.picturePlace = h('div', { hidden: true }, this.pictures.element);
    replace(this, h('div.view', null,
      h('header', null, h('div', null, h('h1', null, t('history.title')), this.subtitle), h('span.spacer'), this.periods), this.form,
      h('div.history-choice', null, h('div.field-row', null, h('label', { for: this.device.id }, t('history.device')), this.device),
        this.selects.map((select, index) => h('div.field-row', null, h('label', { for: select.id }, t(index === 0 ? 'history.attribute' : 'history.second')), select)), this.all),
      this.none, this.charts, this.picturePlace));
  }

  /** The selected device; a seek forgets all for a moment. */
  get entity() {
    const { selection } = store;
    this.known = store.entities.get(selection) ?? (this.known?.id === selection ? this.known : null);
    return this.known;
  }

  get hasPictures() {
    const { entity } = this;
    return entity?.kind === 'camera' || Boolean(entity && store.imageOf(entity));
  }

  /** Devices and attributes appear as they report. */
  schedule() {
    this.timer ??= setTimeout(() => { this.timer = null; this.load(); }, this.key ? 1_000 : 50);
  }

  /** Names of the attributes of the device with numbers, flags or texts of its own, the texts last, the most important of each first. */
  get names() {
    const { entity } = this;
    const important = entity ? keyAttributes(entity, MAX_ATTRIBUTES).map(({ name }) => name) : [];
    const all = [...new Set([...important, ...Object.keys(entity?.attributes ?? {}).sort()])];
    const typeOf = (name) => typeof entity.attributes[name].value;
    return [...all.filter((name) => ['number', 'boolean'].includes(typeOf(name))), ...all.filter((name) => typeOf(name) === 'string' && !CONTEXT.includes(name))].slice(0, MAX_ATTRIBUTES);
  }

  /** The most important attribute when the device was chosen: a later one does not replace it under the eyes of the user. A camera has its pictures instead of a text. */
  get defaultName() {
    const { selection } = store;
    const { names } = this;
    if (this.default?.of !== selection && names.length) {
      const isText = typeof this.entity.attributes[names[0]].value === 'string';
      this.default = { of: selection, name: isText && this.hasPictures ? undefined : names[0] };
    }
    return this.default?.of === selection ? this.default.name : undefined;
  }

  choose(index, name) {
    this.chosen[index] = name;
    this.kept?.[index === 0 ? 'attribute' : 'second'].write();
    this.kept && this.load();
  }

  /** Retains the attributes that the other device has too. */
  chooseDevice(id) {
    store.select(id);
    const { names } = this;
    this.chosen = this.chosen.map((name) => (names.includes(name) ? name : null));
    [this.kept.attribute, this.kept.second].forEach(({ write }) => write());
    this.pictures.at = null;
    this.kept.picture.write();
    this.load();
  }

  chooseAll(ofAll) {
    this.ofAll = ofAll;
    this.all.setAttribute('aria-pressed', String(ofAll));
    this.kept?.pictures.write();
    this.kept && this.load();
  }

  choosePeriod(period) {
    if (PERIODS.includes(period)) {
      this.period = period;
      this.setOwn(null);
    }
  }

  chooseOwn(from, to) {
    from < to && this.setOwn([from, to]);
  }

  setOwn(own) {
    this.own = own;
    this.kept?.period.write();
    this.kept?.own.write();
    this.kept && this.load();
  }

  toggleForm(open = this.form.hidden) {
    this.form.hidden = !open;
    this.periods.lastChild.setAttribute('aria-expanded', String(open));
    if (open) {
      const [from, to] = this.range();
      this.from.show(from);
      this.to.show(to);
    }
  }

  submit(event) {
    event.preventDefault();
    const [from, to] = [Math.round(this.from.time), Math.round(this.to.time)];
    setText(this.wrong, from < to ? '' : t('replays.wrongRange'));
    this.chooseOwn(from, to);
  }

  /** The period, epoch ms: chosen, of the replay, or one that ends now. */
  range() {
    const { from, to } = store.mode;
    const now = Date.now();
    return this.own ?? (store.isReplay && from ? [Math.floor(from), Math.max(from + MINUTE, Math.ceil(to ?? now) + 1)] : [now - this.period, now]);
  }

  /** Reads again what has changed. */
  load() {
    const { entity } = this;
    const { selection } = store;
    this.showDevices();
    const first = this.chosen[0] ?? this.defaultName;
    const attributes = [first, this.chosen[1]].filter((name, index, all) => selection && name && all.indexOf(name) === index);
    this.showAttributes(first);
    const mission = store.isReplay ? entity?.mission ?? store.mode.mission : null;
    const follows = !this.own && !store.isReplay;
    const interval = follows ? Math.max(MIN_INTERVAL, this.period / REFRESHES) : 0;
    setText(this.subtitle, store.isReplay ? t('history.replay', { mission: mission ?? '' }) : t('history.live'));
    this.showPeriod();
    if (selection && !entity && !store.primed) {
      return; // it is not known yet whether the id is that of several devices
    }
    const key = JSON.stringify([selection, entity?.identity, attributes, mission, this.own ?? this.period, store.isReplay && [store.mode.replay, this.range()[0]]]);
    if (key !== this.key) {
      this.key = key;
      this.loadAttributes(entity ?? { name: shortId(selection ?? ''), identity: { id: selection } }, attributes, { mission, interval });
    }
    const hasPictures = this.ofAll || this.hasPictures;
    this.loadPictures(hasPictures && `${key} ${this.ofAll}`, { entity: this.ofAll ? null : entity, range: () => this.range(), interval: interval && Math.max(MINUTE, interval) });
    this.showNone(selection ? 'noAttribute' : 'noDevice', attributes.length > 0 || hasPictures);
  }

  loadAttributes(device, attributes, { mission, interval }) {
    this.panels.forEach((panel, index) => {
      const attribute = attributes[index];
      attribute ? panel.load({ device: device.name, attribute, interval, path: () => pathOf(device, attribute, this.range(), mission) }) : panel.close();
    });
    this.charts.classList.toggle('two', attributes.length === 2);
    replace(this.charts, this.panels.slice(0, attributes.length).map(({ element }) => element));
  }

  /** @param {string|false} key of what is shown; false for no pictures */
  loadPictures(key, request) {
    this.picturePlace.hidden = key === false;
    if (key !== this.pictureKey) {
      this.pictureKey = key;
      key === false ? this.pictures.close() : this.pictures.load(request);
    }
  }

  showNone(name, hidden) {
    this.none.hidden = hidden;
    hidden || replace(this.none, h('h3', null, t(`history.${name}`)), h('p', null, t(`history.${name}Hint`)));
  }

  /** A replay has the period of its mission. */
  showPeriod() {
    const followed = store.isReplay ? 'mission' : String(this.period);
    for (const button of this.periods.children) {
      const { period } = button.dataset;
      button.hidden = period !== 'own' && store.isReplay !== (period === 'mission');
      button.setAttribute('aria-pressed', String(period === (this.own ? 'own' : followed)));
    }
  }

  /** Fills the choice of devices, unless its list is open. */
  showDevices() {
    const entities = [...store.entities.values()].filter((each) => store.inScope(each) || each.id === store.selection);
    const options = entities.map(({ id, name }) => [id, name]).sort(([, one], [, other]) => one.localeCompare(other, undefined, { numeric: true }));
    if (store.selection && !store.entities.has(store.selection)) {
      options.unshift([store.selection, shortId(store.selection)]);
    }
    fill(this.device, [['', t('history.choose')], ...options], store.selection ?? '');
  }

  showAttributes(first) {
    const { names } = this;
    this.selects.forEach((select, index) => {
      const own = index === 0 ? first : this.chosen[1];
      const options = [...new Set([own, ...names].filter(Boolean))].sort((one, other) => (names.indexOf(one) - names.indexOf(other))).map((name) => [name, label(name)]);
      fill(select, index === 0 ? options : [['', t('history.alone')], ...options], own ?? '');
      select.disabled = options.length === 0;
    });
  }
}

function pathOf(device, attribute, [from, to], mission) {
  const { identity } = device;
  const path = identity.service === undefined ? `/api/devices/${encodeURIComponent(identity.id)}/history?` : `${deviceAt(device, '/history')}&`;
  return `${path}${new URLSearchParams({ attribute, from: Math.floor(from), to: Math.ceil(to), ...(mission && { mission }) })}`;
}

/** Fills a choice if its options changed. @param {string[][]} options values and words */
function fill(select, options, value) {
  const key = JSON.stringify(options);
  if (key !== select.dataset.key && document.activeElement !== select) {
    select.dataset.key = key;
    replace(select, options.map(([each, words]) => h('option', { value: each }, words)));
  }
  select.value = value;
}

customElements.define('furrow-history', History);
