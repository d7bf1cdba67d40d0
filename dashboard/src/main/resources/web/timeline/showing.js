/** Updates the texts and marks of the timeline. */
import { h, replace, setText } from '../core/dom.js';
import { clock, dateTime, distance, readable, span } from '../core/format.js';
import { icon } from '../core/icons.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';

const SECOND = 1_000;
const MINUTE = 60_000;
const DAY = 86_400_000;
const MAX_FLAGS = 80;
const NOTE_SHOWN = 8_000;
/** Time for which a replay must wait until that is reported, ms. */
const MIN_WAIT = 3_000;

/** @template T @param {T} Base @returns {T} with methods that show the state */
export const Showing = (Base) => class extends Base {
  showTime() {
    if (store.isReplay) {
      const at = this.position;
      const [, to] = this.extent;
      setText(this.time, `${clock(at)} / ${clock(to)}`);
      this.showSlider(at, [this.extent[0], to]);
    } else {
      setText(this.time, this.moment !== null ? clock(this.moment) : t(store.connection.state === 'lost' ? 'timeline.lost' : 'timeline.live'));
      this.showSlider(this.moment ?? Date.now(), this.extent);
    }
  }

  showSlider(at, [from, to]) {
    const words = store.isReplay
      ? t('timeline.valueReplay', { time: clock(at), done: span(at - from), all: span(to - from), state: this.stateWord() })
      : this.moment === null ? t('timeline.valueLive') : t('timeline.valueMoment', { time: clock(this.moment) });
    const second = Math.floor(at / SECOND);
    if (words !== this.words && (second !== this.second || document.activeElement !== this.track)) {
      this.words = words;
      this.second = second;
      const all = { 'aria-valuemin': 0, 'aria-valuemax': Math.round((to - from) / SECOND), 'aria-valuenow': Math.round((at - from) / SECOND), 'aria-valuetext': words };
      Object.entries(all).forEach(([name, value]) => this.track.setAttribute(name, value));
    }
  }

  stateWord() {
    const state = this.state;
    return t(`replays.states.${state}`);
  }

  /** @returns {'starting'|'waiting'|'running'|'paused'|'ended'|'stopped'|'failed'|'over'} */
  get state() {
    const { state, waiting, replay } = store.mode;
    if (store.replays.get(replay)?.gone) {
      return 'over';
    }
    return waiting && state === 'running' ? 'waiting' : ['running', 'paused', 'ended', 'stopped', 'failed'].includes(state) ? state : 'starting';
  }

  showState() {
    const counts = `${t('timeline.encounters', { count: this.countShown(this.inScope, 'start') })} · ${t('timeline.markers', { count: this.countShown(this.markers, 'time') })}`;
    if (!store.isReplay) {
      setText(this.sub, `${periodText(this.extent[1] - this.extent[0])} · ${t('timeline.encounters', { count: this.inScope.length })}`);
      return;
    }
    const { state } = this;
    const reason = store.mode.reason ?? store.mode.waiting;
    setText(this.sub, state === 'running' ? counts : `${this.stateWord()} · ${counts}`);
    this.sub.title = reason ?? '';
    this.classList.toggle('over', ['ended', 'stopped', 'failed', 'over'].includes(state));
    this.waitingSince = state === 'waiting' ? this.waitingSince ?? Date.now() : null;
    const text = state === 'failed' || (state === 'waiting' && Date.now() - this.waitingSince > MIN_WAIT) ? reason ?? null : null;
    if (text !== this.shownReason) {
      this.announce(readable(text ?? ''), true);
    }
    this.shownReason = text;
    const plays = state === 'running' || state === 'waiting' || state === 'starting';
    if (plays !== this.plays) {
      this.plays = plays;
      replace(this.play, icon(plays ? 'pause' : 'play', 18));
      this.play.setAttribute('aria-label', t(plays ? 'timeline.pause' : 'timeline.play'));
    }
    const speed = String(store.mode.speed ?? 1);
    if (this.speed.value !== speed && document.activeElement !== this.speed) {
      [...this.speed.options].some((each) => each.value === speed)
        || this.speed.append(h('option', { value: speed }, t('timeline.times', { speed })));
      this.speed.value = speed;
    }
    this.loop.setAttribute('aria-pressed', String(Boolean(this.range)));
    this.showActions();
  }

  countShown(moments, key) {
    const [first, last] = this.scale.extent;
    return moments.filter((each) => each[key] >= first - SECOND && each[key] <= last + SECOND).length;
  }

  showActions() {
    const replaying = store.isReplay;
    const may = store.may('operate');
    const over = replaying && this.state === 'over';
    for (const each of [this.back, this.play, this.forward, this.speed, this.loop, this.mark]) {
      each.hidden = !replaying || over || !may;
    }
    this.mark.hidden = !replaying || !may;
    this.more.hidden = !replaying || over || !may;
    const mission = replaying ? store.mode.mission : this.missionToReplay();
    const words = !may ? t('timeline.chooseReplay')
      : over ? t('timeline.startAgain')
        : mission ? t(this.moment === null ? 'timeline.replayMission' : 'timeline.replayFrom', { mission, time: clock(this.moment ?? 0) })
          : this.moment === null || replaying ? t('timeline.chooseReplay') : t('timeline.replayAny', { time: clock(this.moment) });
    this.replayIt.hidden = replaying && !over;
    if (this.replayWords !== words) {
      this.replayWords = words;
      replace(this.replayIt, icon('history', 18), h('span', null, words));
    }
  }

  /** The mission in scope, else the only one with a recent recording. */
  missionToReplay() {
    if (store.scope.mission) {
      return store.recordings.has(store.scope.mission) ? store.scope.mission : null;
    }
    const inDomain = [...store.recordings.keys()].filter((each) => store.scope.domain === null || store.missions.get(each)?.domain === store.scope.domain);
    return inDomain.length === 1 ? inDomain[0] : null;
  }

  showEdges() {
    const { range } = this;
    for (const edge of this.edges) {
      const x = range ? this.scale.x(range[edge.dataset.edge]) : -1;
      edge.hidden = !range || x < 0 || x > this.scale.width;
      edge.style.transform = `translateX(${x}px)`;
    }
  }

  /** The loop while it is drawn, else that of the replay. */
  get range() {
    return this.pointer?.drawn ?? (store.isReplay ? store.mode.range ?? null : null);
  }

  showCover() {
    const { density } = this;
    let words = '';
    if (store.isReplay && this.state !== 'over') {
      words = density.error && !density.counts.size ? t('timeline.noDensity', { reason: density.error.message })
        : density.key !== null && !density.complete && !density.error ? t('timeline.counting') : '';
    }
    this.cover.hidden = words === '';
    setText(this.cover, words);
  }

  showCursor() {
    const { cursor } = store;
    const shown = cursor !== null && this.scale.isShown(cursor);
    this.cursor.hidden = !shown;
    if (shown) {
      this.cursor.style.transform = `translateX(${this.scale.x(cursor)}px)`;
    }
  }

  /** Draws markers; for users who may seek they are buttons. */
  showFlags() {
    const shown = this.markers.filter((each) => this.scale.isShown(each.time)).slice(0, MAX_FLAGS);
    const may = store.may('operate');
    const key = `${shown.map((each) => each.id)} ${may}`;
    if (key !== this.flagKey) {
      this.flagKey = key;
      replace(this.flags, shown.map((marker) => {
        const attributes = { 'aria-label': t('timeline.flag', { note: marker.note, time: clock(marker.time) }), title: `${marker.note}\n${clock(marker.time)} · ${marker.author}` };
        return may ? h('button.tl-flag', { type: 'button', ...attributes, on: { click: () => this.seek(marker.time) } }, icon('flag', 14)) : h('span.tl-flag', { role: 'img', ...attributes }, icon('flag', 14));
      }));
    }
    shown.forEach((marker, index) => (this.flags.children[index].style.transform = `translateX(${this.scale.x(marker.time)}px)`));
  }

  /** Shows a tip. @param {number|null} x null hides it @param {number} time */
  showTip(x, time) {
    this.tip.hidden = x === null;
    if (x === null) {
      return;
    }
    const near = (this.scale.length / this.scale.width) * 4;
    const encounter = this.inScope.find((each) => time >= each.start - near && time <= Math.max(each.end, each.start) + near);
    const marker = this.markers.find((each) => Math.abs(each.time - time) <= near);
    replace(this.tip, h('strong', null, this.scale.length > DAY ? dateTime(time) : clock(time)),
      encounter && h('span.tl-tip-encounter', null, t('timeline.tipEncounter', { pair: encounter.pair, distance: distance(encounter.closest) })),
      marker && h('span', null, marker.note.slice(0, 120)));
    const half = this.tip.offsetWidth / 2;
    this.tip.style.transform = `translateX(${Math.max(0, Math.min(this.scale.width - 2 * half, x - half))}px)`;
  }

  announce(words, isPermanent = false) {
    clearTimeout(this.noteTimer);
    setText(this.note, words);
    this.classList.toggle('noted', words !== '');
    if (!isPermanent && words) {
      this.noteTimer = setTimeout(() => this.announce(''), NOTE_SHOWN);
    }
  }

  toggleDrawer() {
    const open = this.classList.toggle('open');
    this.more.setAttribute('aria-expanded', String(open));
    this.resized();
  }
};

function periodText(ms) {
  return ms < MINUTE ? t('timeline.lastSeconds', { seconds: Math.round(ms / SECOND) }) : t('timeline.lastMinutes', { minutes: Math.round(ms / MINUTE) });
}
