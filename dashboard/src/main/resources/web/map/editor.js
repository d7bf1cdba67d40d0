/** Draws and changes fields on the map: the tools are below it while it is open. */
import { askEnd, askUndo, idFor, lastChange, writeField } from '../core/field-changes.js';
import { h } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { redraw } from '../core/redraw.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { FieldShape, fieldAt } from './field-shape.js';
import { fieldForm, faultWords } from './field-form.js';

const ZONE = { kind: 'exclusion' };

export class FieldEditor {
  /** @param {{map: Object, palette: Object, worked: function()}} owner the map; `worked` is called when the user begins to work on what it shows */
  constructor(owner) {
    this.owner = owner;
    this.element = h('div.map-edit', { role: 'group', 'aria-label': t('draw.title'), hidden: true });
    this.hint = h('p.map-edit-hint', { role: 'status' });
    this.acts = h('div.map-edit-acts');
    this.element.append(this.hint, this.acts);
  }

  get isOpen() {
    return !this.element.hidden;
  }

  toggle() {
    this.isOpen ? this.close() : this.open();
  }

  open() {
    this.element.hidden = false;
    this.shape = new FieldShape(this.owner.map, () => this.owner.palette, {
      drawn: () => { this.step = 'shape'; this.shaped(); this.focus(); this.fault || this.save(); },
      shaped: () => this.shaped(),
    });
    this.subscriptions = [store.on('fields', () => this.step === 'choose' && this.draw())];
    this.choose();
    this.focus();
  }

  close() {
    this.element.hidden = true;
    this.shape?.close();
    this.shape = null;
    this.subscriptions?.forEach((unsubscribe) => unsubscribe());
    this.owner.editorClosed();
  }

  // --- steps -------------------------------------------------------------------------------------------------------

  /** Waits for a choice: a field, or a new one. */
  choose(message = '') {
    Object.assign(this, { step: 'choose', field: null, fault: null, changed: false, message });
    this.shape.clear();
    this.draw();
    this.focus();
  }

  begin(properties) {
    Object.assign(this, { step: 'draw', properties, message: '' });
    this.owner.worked();
    this.shape.draw();
    this.draw();
    this.owner.target.focus(); // where Backspace and Escape are pressed
  }

  change(field) {
    Object.assign(this, { step: 'shape', field, properties: field.properties, fault: null, changed: false, message: '' });
    this.owner.worked();
    this.shape.show(field);
    this.draw();
    this.focus();
  }

  /** The outline was drawn, or its corners were moved. */
  shaped() {
    this.changed = true;
    this.fault = this.shape.fault();
    this.message = '';
    this.draw();
  }

  /** Writes the outline, of a new field with its attributes. */
  async save() {
    if (this.fault || this.busy) {
      return;
    }
    if (!this.field) {
      this.form();
      return;
    }
    this.busy = true;
    try {
      await this.write({ geometry: this.shape.geometry, properties: this.field.properties }, 'draw.moved');
    } catch (error) {
      this.message = error.message;
      this.draw();
    } finally {
      this.busy = false;
    }
  }

  /** Opens the form of the attributes; the corners are those on the map. */
  form() {
    const { field, step } = this;
    const geometry = step === 'choose' ? null : field && !this.changed ? field.geometry : this.shape.geometry;
    const properties = field?.properties ?? { Domain: store.scope.domain ?? ([...store.domains.keys()].length === 1 ? [...store.domains.keys()][0] : undefined), ...(step === 'choose' ? {} : this.properties) };
    fieldForm({ title: field ? t('draw.attributesOf', { field: field.name }) : t(properties.kind ? 'draw.newZone' : 'draw.newField'), properties, geometry }, (draft) => this.write(draft, 'draw.changed'));
  }

  /** @param {{geometry: Object, properties: Object}} draft @param {string} words of a change of a field that exists */
  async write(draft, words) {
    const { field } = this;
    if (field && store.fields.get(field.id)?.version !== field.version) {
      throw new Error(t('draw.conflict', { field: field.name }));
    }
    const { name } = draft.properties;
    await writeField({ id: field?.id ?? idFor(name), ...draft }, field, t(field ? words : 'draw.drawn', { field: name }));
    this.choose(t('draw.saved', { field: name }));
  }

  undo() {
    askUndo((words) => this.choose(words), (error) => { this.message = error.message; this.draw(); });
  }

  /** The focus goes to the tools of a step, unless the user works elsewhere on the page. */
  focus() {
    const { activeElement } = document;
    (activeElement === document.body || this.owner.contains(activeElement)) && this.acts.querySelector('button, select')?.focus();
  }

  // --- the map -----------------------------------------------------------------------------------------------------

  /** @param {Object} event a click on the map */
  click({ coordinate }) {
    const found = this.step === 'choose' || (this.step === 'shape' && this.field && !this.changed) ? fieldAt(coordinate) : null;
    found && found !== this.field && this.change(found);
  }

  /** Goes back a step, unless an outline would be lost: that takes the button. */
  escape() {
    if (this.step === 'choose') {
      this.close();
    } else if (this.step === 'draw' || !this.changed) {
      this.choose();
    }
  }

  /** @returns {boolean} whether the key did something */
  key(event) {
    const isUndo = event.key.toLowerCase() === 'z' && (event.ctrlKey || event.metaKey);
    if (event.key === 'Escape') {
      this.escape();
    } else if (this.step === 'draw' && (isUndo || event.key === 'Backspace')) {
      this.shape.removeLast();
    } else if (this.step === 'choose' && isUndo && lastChange()) {
      this.undo();
    } else {
      return false;
    }
    return true;
  }

  // --- tools -------------------------------------------------------------------------------------------------------

  draw() {
    const words = this.fault ? faultWords(this.fault) : this.message || t(this.step === 'shape' ? 'draw.shapeHint' : this.step === 'draw' ? 'draw.drawHint' : 'draw.chooseHint');
    this.hint.textContent = words;
    this.hint.classList.toggle('bad', Boolean(this.fault));
    redraw(this.acts, { choose: () => this.choices(), draw: () => this.drawing(), shape: () => this.shaping() }[this.step]());
  }

  choices() {
    const change = lastChange();
    const fields = store.fieldsInScope().sort((a, b) => (a.name < b.name ? -1 : 1));
    return [
      act('field', 'plus', 'draw.field', () => this.begin({})),
      act('zone', 'plus', 'draw.zone', () => this.begin(ZONE)),
      act('type', 'list', 'draw.type', () => this.form()),
      fields.length > 0 && h('select.map-edit-field', { 'aria-label': t('draw.changeField'), data: { act: 'draw change' }, on: { change: ({ target }) => { const field = store.fields.get(target.value); field && this.change(field); } } },
        h('option', { value: '' }, t('draw.changeField')), fields.map((each) => h('option', { value: each.id }, each.name))),
      change && h('button.button', { type: 'button', data: { act: 'draw undo' }, on: { click: () => this.undo() } }, icon('undo', 16), h('span.cut', null, t('draw.undo', { change: change.words }))),
      act('done', 'check', 'draw.done', () => this.close()),
    ];
  }

  drawing() {
    return [
      act('last', 'undo', 'draw.removeLast', () => this.shape.removeLast()),
      act('finish', 'check', 'draw.finish', () => this.shape.finish()),
      act('cancel', 'close', 'missions.cancel', () => this.choose()),
    ];
  }

  shaping() {
    const isReady = !this.fault && (this.changed || !this.field);
    return [
      h('button.button.primary', { type: 'button', data: { act: 'draw save' }, 'aria-disabled': String(!isReady), on: { click: () => isReady && this.save() } }, icon('check', 16), t('draw.save')),
      act('attributes', 'pencil', 'draw.attributes', () => this.form()),
      this.field && act('end', 'stop', 'missions.end', () => this.end()),
      act('cancel', 'close', 'missions.cancel', () => this.choose()),
    ];
  }

  end() {
    const { field } = this;
    this.choose();
    askEnd(field, t('missions.fieldActs.end', { field: field.name }));
  }
}

function act(name, symbol, words, click) {
  return h('button.button', { type: 'button', data: { act: `draw ${name}` }, on: { click } }, icon(symbol, 16), t(words));
}
