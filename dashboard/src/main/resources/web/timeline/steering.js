/** Controls the replay that is shown, and starts others. */
import { h, replace } from '../core/dom.js';
import { dateTime } from '../core/format.js';
import { icon } from '../core/icons.js';
import { amendAddress, navigate, route } from '../core/router.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { startReplay, steer } from './control.js';

const SECOND = 1_000;
/** Time within which the list of replays is known, ms. */
const LIST_TIMEOUT = 3_000;

/** @template T @param {T} Base @returns {T} with commands */
export const Steering = (Base) => class extends Base {
  get may() {
    return store.isReplay && store.may('operate') && this.state !== 'over';
  }

  async command(name, body) {
    if (!this.may) {
      return false;
    }
    try {
      await steer(store.mode, name, body);
      this.announce('');
      return true;
    } catch (error) {
      if (name === 'pause' && error.status === 409 && /is paused/.test(error.message)) {
        return true; // a status from before the pause arrived after it
      }
      this.announce(error.message);
      return false;
    }
  }

  async toggle() {
    if (['ended', 'stopped', 'failed'].includes(this.state)) {
      await this.seek(this.extent[0]);
      return;
    }
    const pauses = this.plays;
    if (await this.command(pauses ? 'pause' : 'resume')) {
      store.setProgress({ position: store.now(), at: Date.now(), state: pauses ? 'paused' : 'running' });
    }
  }

  /** @param {number} time epoch ms */
  seek(time, { dragging = false } = {}) {
    if (!this.may) {
      return Promise.resolve();
    }
    const [from, to] = this.extent;
    const at = Math.min(Math.max(time, from), to - 1);
    const loop = store.mode.range;
    if (loop && (at < loop.from || at >= loop.to)) {
      // only positions inside the loop can be sought: a seek out of it ends it
      return dragging ? Promise.resolve() : this.setLoop(null).then(() => store.mode.range || this.seek(at));
    }
    this.sought = { to: at, at: Date.now() };
    dragging || this.scale.reveal(at);
    this.redraw();
    return this.seeking.to(at, store.mode).then(() => this.sought && (this.sought.at = Date.now()));
  }

  /** Steps by events; a group by its clock. */
  async step(count) {
    if (store.mode.group) {
      await this.seek(this.position + count * SECOND);
      return;
    }
    if (this.state === 'running' || this.state === 'waiting') {
      if (!(await this.command('pause'))) {
        return;
      }
      store.setProgress({ position: store.now(), at: Date.now(), state: 'paused' });
    }
    await this.command('step', { count });
  }

  async chooseSpeed() {
    const speed = this.speed.value === 'max' ? 'max' : Number(this.speed.value);
    this.speed.blur();
    if (await this.command('speed', { speed })) {
      store.setProgress({ position: store.now(), at: Date.now(), speed });
    }
  }

  async toggleLoop() {
    if (this.range) {
      await this.setLoop(null);
    } else {
      const from = this.position;
      const length = Math.max(2 * SECOND, Math.min(60 * SECOND, this.scale.length / 4));
      await this.setLoop({ from, to: Math.min(from + length, this.extent[1]) });
    }
  }

  /** @param {{from: number, to: number}|null} range */
  async setLoop(range) {
    const [first, last] = this.extent;
    const body = range ? { from: Math.round(Math.max(first, range.from)), to: Math.round(Math.min(last, range.to)) } : {};
    if (range && body.to - body.from < 100) {
      return;
    }
    if (await this.command('loop', body)) {
      store.setProgress({ range: range ? body : null });
    }
  }

  /** Sets one end of the loop by `[` or `]`; the other is the end of the mission unless it is set. */
  setEdge(edge) {
    const other = edge === 'from' ? 'to' : 'from';
    const range = this.range;
    const next = { ...range, [edge]: this.position };
    next[other] ??= edge === 'from' ? this.extent[1] : this.extent[0];
    if (next.from >= next.to) {
      next[other] = edge === 'from' ? this.extent[1] : this.extent[0];
    }
    this.setLoop(next);
  }

  async startHere() {
    const missions = store.isReplay ? store.mode.missions : [this.missionToReplay()];
    if (!missions[0] || !store.may('operate')) {
      navigate('replays', { mission: missions[0], at: this.moment && new Date(this.moment).toISOString() });
      return;
    }
    this.replayIt.disabled = true;
    const first = Math.min(...missions.map((each) => store.recordings.get(each)?.first ?? 0));
    await this.startAt(missions, store.isReplay ? null : this.moment && Math.max(this.moment, first));
    this.replayIt.disabled = false;
  }

  /** Offers to start a replay at the moment of a link, if the linked replay no longer exists. */
  openLink() {
    const { replay, mission, at } = route.query;
    const time = /^\d+$/.test(at ?? '') ? Number(at) : Date.parse(at);
    clearTimeout(this.linking);
    this.offer.hidden = true;
    if (route.view !== 'map' || !mission || !Number.isFinite(time)) {
      return;
    }
    const missions = mission.split(',');
    this.linking = setTimeout(() => {
      const existing = store.replays.get(replay);
      if (store.mode.replay === replay || (existing?.topic && !existing.gone)) {
        return;
      }
      const may = store.may('operate') && missions.every((each) => store.recordings.has(each));
      const close = () => { this.offer.hidden = true; amendAddress({ mission: null, at: null }); };
      replace(this.offer,
        h('p', null, h('strong', null, t('replays.link', { missions: missions.join(' + ') })), h('br'), t(may ? 'replays.linkHint' : 'replays.linkOver', { time: dateTime(time) })),
        h('div.row', null,
          may && h('button.button.primary.small', { type: 'button', on: { click: () => { close(); this.startAt(missions, time); } } }, icon('play', 16), t('replays.linkStart')),
          h('button.button.small.quiet', { type: 'button', on: { click: close } }, t(may ? 'timeline.cancel' : 'missions.close'))));
      this.offer.hidden = false;
    }, replay ? LIST_TIMEOUT : 0);
  }

  async startAt(missions, time) {
    this.announce(t('timeline.starting'), true);
    try {
      await startReplay({ ...(missions.length > 1 ? { missions } : { mission: missions[0] }), analytics: store.config.analytics }, time || null);
      this.announce('');
    } catch (error) {
      this.announce(error.message === 'not-played' ? t('replays.notPlayed') : error.message, true);
    }
  }
};
