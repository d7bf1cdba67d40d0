/** The timeline below the map: recent records, or the position and controls of a replay. */
import { replace } from '../core/dom.js';
import { onRoute } from '../core/router.js';
import { store } from '../core/store.js';
import { SEEK_TOLERANCE, Seeking } from './control.js';
import { Density } from './density.js';
import { draw, palette, sharp } from './draw.js';
import { keyOf } from './keys.js';
import { LIVE_LENGTH, LiveDensity } from './live.js';
import { Loading, MOMENTS_INTERVAL } from './loading.js';
import { openMarker } from './marker-dialog.js';
import { isBetween } from './moments.js';
import { Parts } from './parts.js';
import { Pointer } from './pointer.js';
import { Scale } from './scale.js';
import { Showing } from './showing.js';
import { Steering } from './steering.js';

const BAR = 6;
const JUMP = 10_000;
const SECOND = 1_000;
/** Time for which a requested seek is shown until the replay reports its position, ms. */
const SEEK_TIMEOUT = 3_000;

class Timeline extends Parts(Loading(Showing(Steering(HTMLElement)))) {
  connectedCallback() {
    this.scale = new Scale();
    this.live = new LiveDensity(() => this.redraw());
    this.density = new Density(() => this.redraw());
    this.encounters = [];
    this.markers = [];
    this.sought = null;
    this.moment = null;
    this.seeking = new Seeking((error) => { this.sought = null; this.announce(error.message); });
    this.build();
    this.pointer = new Pointer(this.track, this);
    this.observer = new ResizeObserver(() => this.resized());
    this.observer.observe(this.track);
    this.onKey = (event) => this.key(event);
    this.onScheme = () => { this.colors = null; this.redraw(); };
    document.addEventListener('keydown', this.onKey);
    window.addEventListener('schemechange', this.onScheme);
    this.subscriptions = [
      store.on('mode', () => this.modeChanged()),
      store.on('clock', () => this.tick()),
      store.on('encounters', () => this.applyEncounters()),
      store.on('recordings', () => this.showActions()),
      store.on('scope', () => { this.live.tick(); this.showActions(); this.showState(); this.redraw(); }),
      store.on('me', () => this.showActions()),
      store.on('cursor', () => this.showCursor()),
      store.on('connection', () => this.showState()),
      onRoute(() => this.openLink()),
    ];
    this.timer = setInterval(() => document.hidden || this.move(), this.stepTime());
    this.lastMoments = 0;
    this.modeChanged();
    this.openLink();
  }

  disconnectedCallback() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
    clearTimeout(this.linking);
    clearInterval(this.timer);
    clearTimeout(this.noteTimer);
    this.density.clear();
    this.observer.disconnect();
    document.removeEventListener('keydown', this.onKey);
    window.removeEventListener('schemechange', this.onScheme);
  }

  /** Interval of the play head: it moves smoothly, or in steps if motion is to be reduced. */
  stepTime() {
    return matchMedia('(prefers-reduced-motion: reduce)').matches ? SECOND : 100;
  }

  modeChanged() {
    const replaying = store.isReplay;
    const key = replaying ? `${store.mode.replay} ${store.mode.missions}` : 'live';
    this.classList.toggle('replay', replaying);
    if (key !== this.shown) {
      this.shown = key;
      this.sought = null;
      this.moment = null;
      this.encounters = [];
      this.markers = [];
      this.lastMoments = 0;
      this.density.clear();
      this.live.seen = null;
      this.tip.hidden = true;
      this.scale = Object.assign(new Scale(), { width: this.scale.width });
      replace(this.flags);
    }
    this.showActions();
    this.tick();
  }

  get extent() {
    if (!store.isReplay) {
      return this.live.extent();
    }
    const { position, missions, replay } = store.mode;
    // the requested range; the mission may still be recorded
    const requested = store.replays.get(replay);
    const [from, to] = [requested?.from ?? store.mode.from, requested?.to ?? store.mode.to];
    const recordings = (missions ?? []).map((each) => store.recordings.get(each)).filter(Boolean);
    const begin = Math.min(...recordings.map((each) => each.first));
    // positions before the recording cannot be sought
    const first = from !== undefined && recordings.length && !requested?.source ? Math.max(from, begin) : from ?? begin;
    const last = Math.max(to ?? 0, ...recordings.filter(() => to === undefined).map((each) => each.last));
    this.bounded = Number.isFinite(first) && last > first;
    return this.bounded ? [first, last] : [position ?? 0, (position ?? 0) + SECOND];
  }

  extend() {
    this.scale.setExtent(...this.extent);
  }

  /** The position shown, epoch ms. */
  get position() {
    if (this.pointer?.scrubbing !== null && this.pointer?.scrubbing !== undefined) {
      return this.pointer.scrubbing;
    }
    const { sought } = this;
    if (sought) {
      const { speed, position } = store.mode;
      const near = Math.abs(position - sought.to) <= SEEK_TOLERANCE + SEEK_TOLERANCE * (typeof speed === 'number' ? speed : 1);
      if (this.seeking.busy || (Date.now() - sought.at < SEEK_TIMEOUT && !near)) {
        return sought.to;
      }
      this.sought = null;
    }
    return store.now();
  }

  // --- drawing -----------------------------------------------------------------------------------------------------

  resized() {
    this.scale.width = Math.max(1, this.track.clientWidth);
    this.height = this.track.clientHeight;
    this.redraw();
  }

  /** Updates each second, and with each status of a replay. */
  tick() {
    this.extend();
    // what devices report is shown first
    if ((store.isReplay || store.primed) && Date.now() - this.lastMoments > (store.isReplay ? MOMENTS_INTERVAL : LIVE_LENGTH)) {
      this.loadMoments();
    }
    store.isReplay ? this.encounters.filter(isBetween).forEach((each) => store.applyRecordedEncounter(each)) : this.live.tick();
    this.showState();
    this.redraw();
  }

  redraw() {
    if (!this.drawing) {
      this.drawing = requestAnimationFrame(() => {
        this.drawing = null;
        this.isConnected && this.height && this.draw();
      });
    }
  }

  draw() {
    const { scale, height } = this;
    this.colors ??= palette(this);
    const replaying = store.isReplay;
    if (replaying && this.bounded && store.mode.missions?.length) {
      this.density.request(store.mode.missions, scale.from, scale.to, Math.max(20, Math.floor(scale.width / BAR)));
    }
    this.canvas.style.width = `${scale.width}px`;
    this.canvas.style.height = `${height}px`;
    draw(sharp(this.canvas, scale.width, height), {
      scale, height, colors: this.colors, encounters: this.inScope, density: replaying ? this.density : this.live,
      position: this.position, range: this.range, kind: store.mode.kind,
    });
    this.showEdges();
    this.showFlags();
    this.showCover();
    this.showCursor();
    this.move();
  }

  /** Moves the play head; redraws the rest only when it enters another bucket. */
  move() {
    const at = store.isReplay ? this.position : this.moment ?? Date.now();
    if (!store.isReplay && this.moment === null) {
      this.extend();
    }
    const x = this.scale.x(at);
    this.head.hidden = x < -1 || x > this.scale.width + 1;
    this.head.style.transform = `translateX(${Math.min(this.scale.width - 1, Math.max(0, x))}px)`;
    const bucket = Math.floor(x / BAR);
    if (bucket !== this.bucket) {
      this.bucket = bucket;
      this.redraw();
    }
    this.showTime();
  }

  openMarker() {
    if (store.isReplay && store.may('operate')) {
      openMarker({ mission: store.mode.mission, time: this.position, markers: this.markers }, {
        changed: () => this.loadMoments(), closed: () => this.track.focus({ preventScroll: true }),
      });
    }
  }

  // --- pointer and keys --------------------------------------------------------------------------------------------

  zoom(factor, x = this.scale.x(this.position)) {
    const at = x >= 0 && x <= this.scale.width ? x : this.scale.width / 2;
    this.scale.zoom(factor, at);
    this.redraw();
  }

  pan(pixels) {
    this.scale.pan((pixels / this.scale.width) * this.scale.length);
    this.redraw();
  }

  /** A click or drag in live data chooses the moment from which a mission would be replayed. */
  choose(time) {
    if (!store.may('operate')) {
      return;
    }
    this.moment = time === null || time > Date.now() - SECOND ? null : time;
    this.showActions();
    this.move();
  }

  key(event) {
    const act = keyOf(event, this);
    if (!act) {
      return;
    }
    if (act === 'leave') {
      this.choose(null);
      return;
    }
    if (!store.isReplay) {
      const moves = { back: -SECOND, forward: SECOND, jumpBack: -JUMP, jumpForward: JUMP };
      if (moves[act] && document.activeElement === this.track) {
        event.preventDefault();
        this.choose(Math.max(this.extent[0], (this.moment ?? Date.now()) + moves[act]));
      }
      return;
    }
    event.preventDefault();
    const acts = {
      toggle: () => this.toggle(), back: () => this.step(-1), forward: () => this.step(1), jumpBack: () => this.seek(this.position - JUMP), jumpForward: () => this.seek(this.position + JUMP),
      loopFrom: () => this.setEdge('from'), loopTo: () => this.setEdge('to'), start: () => this.seek(this.extent[0]), end: () => this.seek(this.extent[1] - 1),
      mark: () => this.openMarker(), zoomIn: () => this.zoom(0.5), zoomOut: () => this.zoom(2),
    };
    acts[act]?.();
  }
}

customElements.define('furrow-timeline', Timeline);
