/** Lists topics with the number and rate of their records, and shows records of chosen topics. */
import { absence } from '../core/absence.js';
import { resource } from '../core/resource.js';
import { decimal, number } from '../core/format.js';
import { h, replace, setText } from '../core/dom.js';
import { icon } from '../core/icons.js';
import { nameFromTopic } from '../core/identities.js';
import { navigate, parameter } from '../core/router.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { Records } from './topics/records.js';
import { arrange } from './topics/tree.js';

const POLL_MILLIS = 2_000;
const FOLDED = new Set(['replays', 'service', 'other']);
/** Below this width the records are below the topics. */
const NARROW = matchMedia('(max-width: 900px)');
/** Topics whose records are shown; retained while another view is shown. */
const chosen = new Set();

class FurrowTopics extends HTMLElement {
  connectedCallback() {
    this.figures = new Map();
    this.rows = new Map();
    this.tree = h('div.topic-tree');
    this.records = new Records();
    this.kept = parameter('topic', { view: 'topics', get: () => [...chosen].join(), set: (topics) => this.chooseAll(topics.split(',')) });
    this.records.choose(chosen);
    replace(this, h('div.view', null,
      h('header', null, h('h1', null, t('views.topics')), h('span.spacer'), h('p.small.muted', null, t('topics.hint'))),
      h('div.topic-columns', null, this.tree, this.records.element)));
    this.list = resource('/api/topics', { interval: POLL_MILLIS });
    this.subscriptions = [this.list.on(() => this.update()), ...['domains', 'missions', 'scope'].map((name) => store.on(name, () => this.draw())), this.kept.close];
    replace(this.tree, [0, 1, 2, 3, 4].map(() => h('div.skeleton.topic-skeleton', null, '…')));
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    this.list.close();
    this.records.close();
  }

  /** Computes rates from two successive responses. */
  update() {
    if (this.list.error) {
      replace(this.tree, h('p.error-note', { role: 'alert' }, icon('warning'), this.list.error.message));
      this.key = null;
      return;
    }
    const now = performance.now();
    for (const { name, written } of this.list.value) {
      const previous = this.figures.get(name);
      if (previous && now - previous.at < POLL_MILLIS / 4) {
        continue;
      }
      const rate = previous ? Math.max(0, written - previous.written) / ((now - previous.at) / 1000) : 0;
      this.figures.set(name, { written, at: now, rate: previous ? 0.5 * rate + 0.5 * previous.rate : rate });
    }
    this.draw();
  }

  draw() {
    if (!this.list.value || this.list.error) {
      return;
    }
    const tree = arrange(this.list.value, store.domains.keys(), store.missions.values());
    const key = JSON.stringify([tree, store.scope, store.lists.domains.loading, store.lists.domains.error?.message]);
    if (key !== this.key) {
      this.key = key;
      this.drawTree(tree);
    }
    for (const [name, row] of this.rows) {
      const figures = this.figures.get(name);
      setText(row.count, figures ? number(figures.written) : '–');
      setText(row.rate, figures ? t('topics.rate', { rate: figures.rate < 10 ? decimal(figures.rate, 1) : Math.round(figures.rate) }) : '');
      row.element.classList.toggle('flowing', figures?.rate > 0.05);
    }
  }

  drawTree(tree) {
    const open = new Set([...this.tree.querySelectorAll('details[open]')].map((each) => each.dataset.name));
    const focused = this.tree.contains(document.activeElement) ? document.activeElement.id : null;
    this.rows.clear();
    const rowOf = (name) => h('li', null, this.row(tree.absent.includes(name) ? null : name, name));
    const section = (name, topics) => topics.length > 0 && (FOLDED.has(name)
      ? h('details', { data: { name }, open: open.has(name) }, h('summary.section-title', null, h('span', null, t(`topics.sections.${name}`)), h('span.numbers', null, topics.length)), h('ul', null, topics.map(rowOf)))
      : h('section', null, h('h2.section-title', null, t(`topics.sections.${name}`)), h('ul', null, topics.map(rowOf))));
    replace(this.tree,
      section('results', tree.results),
      h('section', null, h('h2.section-title', null, t('topics.sections.domains')),
        h('ul', null, tree.domains.map((each) => this.domain(each))), absence('domains', tree.domains.length - 1, () => h('p.small.muted', null, t('topics.noDomains')))),
      section('all', tree.all), section('replays', tree.replays), section('service', tree.service), section('other', tree.other));
    focused && this.tree.querySelector(`#${CSS.escape(focused)}`)?.focus();
  }

  domain({ domain, topic, missions }) {
    return h('li.topic-domain', null,
      this.row(topic, nameFromTopic(domain), { domain }),
      missions.length > 0 && h('ul', null, missions.map((each) => h('li', null, this.row(each.topic, nameFromTopic(each.mission), { domain, mission: each.mission })))));
  }

  /** @param {string|null} topic null if there are no records yet */
  row(topic, words, scope) {
    const id = `topic-${topic ?? words}`;
    const check = h('input', { type: 'checkbox', id, disabled: topic === null, checked: chosen.has(topic), on: { change: () => this.choose(topic, check.checked) } });
    const count = h('span.numbers.muted.small');
    const rate = h('span.numbers.small.topic-rate');
    const shown = scope && store.scope.domain === scope.domain && store.scope.mission === (scope.mission ?? null);
    const element = h('div.topic-row', null, check, h('label.cut', { for: id, title: topic ?? '' }, words),
      topic === null && h('span.small.muted', null, t('topics.noneYet')), rate, count,
      scope && h('button.button.quiet.square.small', {
        type: 'button', 'aria-pressed': String(shown), 'aria-label': t(shown ? 'topics.showAll' : 'topics.showOnly', { name: words }), title: t(shown ? 'topics.showAll' : 'topics.showOnly', { name: words }),
        on: { click: () => this.scope(shown ? {} : scope) },
      }, icon('map', 16)));
    topic && this.rows.set(topic, { element, check, count, rate });
    return element;
  }

  choose(topic, on) {
    on ? chosen.add(topic) : chosen.delete(topic);
    this.records.choose(chosen);
    on && chosen.size === 1 && NARROW.matches && this.records.element.scrollIntoView({ block: 'start' });
    this.kept.write();
  }

  chooseAll(topics) {
    chosen.clear();
    topics.forEach((each) => chosen.add(each));
    this.records.choose(chosen);
    this.rows.forEach(({ check }, name) => (check.checked = chosen.has(name)));
  }

  /** Limits the map and the cards to a domain or mission. */
  scope(scope) {
    store.setScope(scope);
    scope.domain && navigate('map');
  }
}

customElements.define('furrow-topics', FurrowTopics);
