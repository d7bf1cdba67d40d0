/** The card of one entity: attributes, series, image, commands and details. */
import { api } from '../core/api.js';
import { age, bytes, displayOf, label, temperature, word } from '../core/format.js';
import { h, replace, setText } from '../core/dom.js';
import { openDialog } from '../core/dialog.js';
import { icon } from '../core/icons.js';
import { linkTo } from '../core/router.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { allAttributes, lineOf, keyAttributes } from './attributes.js';
import { sentencesOf } from './connection.js';
import { commandsOf, deviceAt, isPointless, outcomeWords, sendCommand } from './commands.js';
import { Picture } from './picture.js';
import { Sparkline } from './sparkline.js';

/** Interval at which the connection of a device is read while its details are shown. */
const REQUEST_INTERVAL = 10_000;
/** Time in which the outcome of a command is read: longer than a missing answer is awaited, ms. */
const OUTCOME_TIME = 60_000;

export class Card {
  /** @param {import('../core/entity.js').Entity} entity */
  constructor(entity) {
    this.entity = entity;
    this.sent = null;
    this.open = false;
    this.requestedAt = -Infinity;
    this.connection = [];
    this.name = h('button.card-name', { type: 'button', on: { click: () => store.select(entity.id, { reveal: true }) } });
    this.mark = h('span.card-mark');
    this.age = h('span.numbers.muted.small');
    this.facts = h('dl.card-facts');
    this.spark = new Sparkline();
    this.picture = new Picture();
    this.buttons = h('div.card-commands');
    this.outcome = h('span.card-outcome.small');
    this.said = h('span.visually-hidden', { role: 'status' });
    this.details = h('div.card-details', { hidden: true, id: `details-${Card.count++}` });
    this.more = h('button.button.quiet.square.small', {
      type: 'button', 'aria-expanded': 'false', 'aria-controls': this.details.id, on: { click: () => this.toggle() },
    }, icon('chevron-down', 18));
    this.history = h('a.button.quiet.square.small', { title: t('history.title') }, icon('chart', 18));
    this.element = h('li.card.device', { data: { id: entity.identity.id }, on: {
      pointerenter: () => store.setHovered(entity.id), pointerleave: () => store.setHovered(null), focusin: () => store.setHovered(entity.id),
    } },
      h('div.card-head', null, h('h3.cut', null, this.name), this.mark, this.age, this.history, this.more),
      this.facts, this.spark.element, this.picture.element, h('div.card-row', null, this.buttons, this.outcome, this.said), this.details);
    this.element.card = this;
  }

  draw() {
    const { entity } = this;
    const now = store.now();
    setText(this.name, entity.name);
    setText(this.age, age(now - entity.time));
    this.element.className = `card device is-${entity.state}${entity.id === store.selection ? ' selected' : ''}${entity.id === store.hovered ? ' hovered' : ''}`;
    const word = this.wordOf();
    setText(this.mark, word.text);
    this.mark.className = `card-mark small ${word.className}`;
    this.more.setAttribute('aria-label', t('cards.details', { name: entity.name }));
    this.history.setAttribute('aria-label', t('history.of', { name: entity.name }));
    this.history.href = linkTo('history', { select: entity.id });
    this.drawFacts(now);
    const line = lineOf(entity);
    this.spark.draw(line, line && { label: label(line.name), ...displayOf(line.name, entity.attributes[line.name]) });
    this.picture.draw(entity);
    this.drawCommands();
    this.open && this.drawDetails();
  }

  wordOf() {
    const { entity } = this;
    if (entity.state === 'stale' || entity.state === 'off') {
      return { text: t(`states.${entity.state}`), className: 'muted' };
    }
    if (entity.suspect) {
      return { text: t('cards.suspect'), className: 'warn' };
    }
    if (entity.positionFault) {
      return { text: t('cards.noPosition'), className: 'warn' };
    }
    return entity.state === 'attention' ? { text: t('states.attention'), className: 'warn' } : { text: '', className: '' };
  }

  drawFacts() {
    const { entity } = this;
    const facts = [];
    if (entity.word) {
      facts.push({ label: t('cards.state'), value: word(entity.word, 'reported'), unit: '' });
    }
    facts.push(...keyAttributes(entity, 3));
    const suspect = store.suspects.get(entity.id);
    if (suspect) {
      facts.splice(2, 0, { label: t('cards.fieldMean'), value: temperature(suspect.mean), unit: '' });
    }
    if (entity.cut) {
      facts.unshift({ label: t('cards.tooLarge'), value: bytes(entity.cut), unit: '' });
    }
    const shown = facts.slice(0, 3);
    while (this.facts.children.length > shown.length) {
      this.facts.lastChild.remove();
    }
    shown.forEach((fact, index) => {
      const place = this.facts.children[index] ?? this.facts.appendChild(h('div', null, h('dt.cut'), h('dd.cut.numbers')));
      setText(place.firstChild, fact.label);
      setText(place.lastChild, fact.unit ? `${fact.value} ${fact.unit}` : fact.value);
      place.lastChild.title = place.lastChild.textContent;
    });
  }

  // --- commands ----------------------------------------------------------------------------------------------------

  drawCommands() {
    const { entity } = this;
    const commands = store.may('operate') ? commandsOf(entity) : [];
    const recorded = store.isReplay;
    const key = `${entity.name} ${commands.map((each) => `${each.name}${each.primary}${isPointless(entity, each.name)}`).join()} ${recorded} ${this.sent?.waiting}`;
    if (key !== this.commandsKey) {
      this.commandsKey = key;
      replace(this.buttons, commands.map((command) => h('button.button.small', {
        type: 'button', class: command.primary ? 'primary' : '', 'aria-label': `${nameOf(command)}: ${entity.name}`, disabled: recorded || isPointless(entity, command.name) || Boolean(this.sent?.waiting),
        on: { click: () => this.request(command) },
      }, nameOf(command))));
      this.buttons.parentElement.hidden = commands.length === 0;
    }
    this.drawOutcome(recorded);
  }

  drawOutcome(recorded) {
    const { text, kind } = recorded ? { text: t('cards.recorded'), kind: '' } : this.sent ? outcomeWords(this.entity, this.sent) : { text: '', kind: '' };
    setText(this.outcome, text);
    // its age changes each second, and is not read out
    const state = `${kind} ${this.sent?.at}`;
    state === this.saidState || setText(this.said, this.sent && !recorded ? text : '');
    this.saidState = state;
    this.outcome.className = `card-outcome small ${kind || 'muted'}`;
  }

  request(command) {
    const send = () => { sendCommand(this.entity, command.name, (sent) => { this.sent = sent; this.drawCommands(); }); };
    command.risky ? openDialog({ title: t('cards.confirm', { command: word(command.name, 'commands'), name: this.entity.name }), submit: nameOf(command), danger: true, body: [], work: send }) : send();
  }

  /** Whether a command was sent recently. */
  isCommanded() {
    return this.sent !== null && Date.now() - this.sent.at < OUTCOME_TIME;
  }

  // --- details -----------------------------------------------------------------------------------------------------

  toggle() {
    this.open = !this.open;
    this.details.hidden = !this.open;
    this.more.setAttribute('aria-expanded', String(this.open));
    this.open && this.drawDetails();
  }

  drawDetails() {
    const { entity } = this;
    this.loadConnection();
    replace(this.details,
      h('p.small.muted', null, [entity.type, entity.domain, entity.mission, entity.difference && `${entity.identity.service} ${entity.identity.servicePath}`.trim()].filter(Boolean).join(' · ')),
      h('p.small.muted.code', null, entity.identity.id),
      this.connection.map((sentence) => h('p.small.connection', null, sentence)),
      h('dl.attributes', null, allAttributes(entity).map(({ name, value }) => h('div', null, h('dt', null, name.slice(0, 80)), h('dd.numbers', null, value)))),
      entity.omitted > 0 && h('p.small.muted', null, t('cards.omitted', { count: entity.omitted })));
  }

  /** Reads the connection of a device. The control plane knows only devices of missions. */
  async loadConnection() {
    if (store.isReplay || !this.entity.mission || Date.now() - this.requestedAt < REQUEST_INTERVAL) {
      return;
    }
    this.requestedAt = Date.now();
    try {
      const { connection } = await api.get(deviceAt(this.entity));
      this.connection = sentencesOf(connection);
    } catch {
      this.connection = [];
    }
    this.open && this.drawDetails();
  }

  release() {
    this.picture.release();
  }
}
Card.count = 0;

function nameOf({ name }) {
  const own = word(name, 'commands');
  return own.charAt(0).toUpperCase() + own.slice(1);
}
