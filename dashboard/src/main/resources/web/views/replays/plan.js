/** The form of a new replay: missions, range and speed. */
import { h, replace, setText } from '../../core/dom.js';
import { duration, zone } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { TimeInput, timeElement } from '../../core/local-time.js';
import { navigate } from '../../core/router.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { SPEEDS, startReplay } from '../../timeline/control.js';

const SHORTENED = 'PT30S';

export class Plan {
  constructor() {
    this.missions = [];
    this.heading = h('h2');
    this.hint = h('p.muted.small');
    this.from = this.timeInput('plan-from', false);
    this.to = this.timeInput('plan-to', true);
    this.fromLabel = h('label', { for: 'plan-from' });
    this.toLabel = h('label', { for: 'plan-to' });
    this.length = h('span.small.muted.numbers');
    this.speed = h('select', { id: 'plan-speed' }, SPEEDS.map((speed) =>
      h('option', { value: speed, selected: speed === 4 }, speed === 'max' ? t('replays.fastest') : t('replays.times', { speed }))));
    this.analytics = h('input', { type: 'checkbox', checked: true, id: 'plan-analytics', 'aria-describedby': 'plan-analytics-hint' });
    this.loop = h('input', { type: 'checkbox', id: 'plan-loop' });
    this.skip = h('input', { type: 'checkbox', id: 'plan-skip' });
    this.skipRow = h('label.check', { for: 'plan-skip' }, this.skip, t('replays.skip'));
    this.start = h('button.button.primary', { type: 'submit' });
    this.failed = h('p.error-note', { role: 'alert', hidden: true });
    this.form = h('form.stack', { on: { submit: (event) => this.submit(event) } },
      h('div.plan-range', null,
        h('div.field-row', null, this.fromLabel, this.from.element),
        h('div.field-row', null, this.toLabel, this.to.element)),
      this.length,
      h('div.field-row', null, h('label', { for: 'plan-speed' }, t('replays.speed')), this.speed),
      h('div.stack.plan-checks', null,
        h('label.check', { for: 'plan-analytics' }, this.analytics, t('replays.analytics')),
        h('p.small.muted', { id: 'plan-analytics-hint' }, t('replays.analyticsHint')),
        h('label.check', { for: 'plan-loop' }, this.loop, t('replays.loop')), this.skipRow),
      this.failed, this.start);
    this.element = h('section.panel.plan', { 'aria-label': t('replays.plan') }, this.heading, this.hint, this.form);
    this.show([]);
  }

  /** Shows the form. @param {string[]} missions @param {number=} at where to begin, epoch ms */
  show(missions, at) {
    const changed = missions.join() !== this.missions.join();
    this.missions = missions;
    const recordings = missions.map((each) => store.recordings.get(each)).filter(Boolean);
    const may = store.may('operate');
    setText(this.heading, missions.length ? t('replays.planOf', { missions: missions.join(' + ') }) : t('replays.plan'));
    setText(this.hint, !may ? t('replays.viewer') : missions.length === 0 ? t('replays.chooseOne') : missions.length > 1 ? t('replays.oneClock') : '');
    this.hint.hidden = this.hint.textContent === '';
    this.form.hidden = !may || missions.length === 0;
    this.skipRow.hidden = missions.length > 1;
    const fastest = this.speed.querySelector('option[value="max"]');
    fastest.disabled = missions.length > 1;
    if (fastest.disabled && this.speed.value === 'max') {
      this.speed.value = '60';
    }
    if (recordings.length) {
      this.span = [Math.min(...recordings.map((each) => each.first)), Math.max(...recordings.map((each) => each.last))];
      const [first, last] = this.span;
      (changed || !this.from.isChosen) && this.from.show(at > first && at < last ? at : first);
      (changed || !this.to.isChosen) && this.to.show(last);
      this.rangeShown();
    }
    this.ready();
  }

  ready() {
    this.start.disabled = this.busy || !this.isRangeValid();
    replace(this.start, icon('play', 18), t(this.busy ? 'replays.starting' : 'replays.start'));
  }

  timeInput(id, last) {
    return new TimeInput(timeElement({ id, on: { input: () => { this.rangeShown(); this.ready(); } } }), last);
  }

  /** Whether the range is valid. A recording with a single event has no length, and can be replayed. */
  isRangeValid() {
    const [from, to] = this.range();
    return to > from || (to === from && !this.to.isChosen);
  }

  range() {
    return [this.from.time, this.to.time];
  }

  rangeShown() {
    const [from, to] = this.range();
    setText(this.fromLabel, t('replays.from', { zone: zone(from || Date.now()) }));
    setText(this.toLabel, t('replays.to', { zone: zone(to || Date.now()) }));
    setText(this.length, this.isRangeValid() ? `${t('replays.length')}: ${duration(to - from)}` : t('replays.wrongRange'));
  }

  async submit(event) {
    event.preventDefault();
    this.busy = true;
    this.failed.hidden = true;
    this.ready();
    const [from, to] = this.range();
    const many = this.missions.length > 1;
    const [first, last] = this.span;
    try {
      await startReplay({
        ...(many ? { missions: this.missions } : { mission: this.missions[0] }),
        speed: this.speed.value === 'max' ? 'max' : Number(this.speed.value),
        ...(from > first ? { from: Math.round(from) } : {}),
        ...(this.to.isChosen && to <= last ? { to: Math.round(to) } : {}),
        ...(this.loop.checked ? { loop: true } : {}),
        ...(this.analytics.checked ? { analytics: store.config.analytics } : {}),
        ...(this.skip.checked && !many ? { maxGap: SHORTENED } : {}),
      });
      navigate('map');
    } catch (error) {
      replace(this.failed, icon('warning', 18), error.message === 'not-played' ? t('replays.notPlayed') : error.message);
      this.failed.hidden = false;
    } finally {
      this.busy = false;
      this.ready();
    }
  }
}
