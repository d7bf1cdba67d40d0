/** Handles pointer, wheel and pinch on the track of the timeline. */
import { store } from '../core/store.js';
import { RULER } from './draw.js';

/** Distance within which a handle is hit, px. */
const HIT_DISTANCE = 8;
const MIN_DRAG = 3;

export class Pointer {
  /** @param {HTMLElement} track @param {Object} timeline whose scale, seek, setLoop, choose, showTip, zoom and pan are used */
  constructor(track, timeline) {
    this.track = track;
    this.timeline = timeline;
    this.points = new Map();
    /** Time of the dragged play head, epoch ms; null if it is not dragged. */
    this.scrubbing = null;
    /** The loop while it is drawn. */
    this.drawn = null;
    track.addEventListener('pointerdown', (event) => this.down(event));
    track.addEventListener('pointermove', (event) => this.moved(event));
    track.addEventListener('pointerup', (event) => this.up(event));
    track.addEventListener('pointercancel', (event) => this.cancel(event));
    track.addEventListener('pointerleave', () => this.points.size || this.left());
    track.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    track.addEventListener('dblclick', () => { timeline.scale.showAll(); timeline.redraw(); });
  }

  left() {
    this.timeline.showTip(null);
    store.setCursor(null);
  }

  at(event) {
    const box = this.track.getBoundingClientRect();
    const x = Math.min(Math.max(0, event.clientX - box.left), box.width);
    return { x, y: event.clientY - box.top, time: this.timeline.scale.time(x) };
  }

  down(event) {
    if (event.button !== 0) {
      return;
    }
    this.track.setPointerCapture(event.pointerId);
    const at = this.at(event);
    this.points.set(event.pointerId, at);
    if (this.points.size === 2) {
      this.begin('pinch', at);
      this.scrubbing = null;
      this.drawn = null;
      return;
    }
    if (!store.isReplay) {
      this.begin('choose', at);
      this.timeline.choose(at.time);
      return;
    }
    if (!this.timeline.may) {
      return;
    }
    const edge = this.edgeAt(at);
    if (edge) {
      this.begin('edge', at);
      this.edge = edge;
      this.drawn = { ...this.timeline.range };
    } else if (at.y < RULER) {
      this.begin('loop', at);
    } else {
      this.begin('scrub', at);
      this.scrub(at);
    }
  }

  begin(kind, at) {
    this.kind = kind;
    this.origin = at;
  }

  edgeAt({ x }) {
    const { range, scale } = this.timeline;
    if (!range) {
      return null;
    }
    const distances = ['from', 'to'].map((edge) => [edge, Math.abs(scale.x(range[edge]) - x)]).sort((a, b) => a[1] - b[1]);
    return distances[0][1] <= HIT_DISTANCE ? distances[0][0] : null;
  }

  scrub({ x, time }) {
    this.scrubbing = time;
    this.timeline.showTip(x, time);
    this.timeline.move();
    this.timeline.seek(time, { dragging: true });
  }

  moved(event) {
    const at = this.at(event);
    if (!this.points.has(event.pointerId)) {
      event.pointerType === 'touch' || this.hover(at);
      return;
    }
    const previous = new Map(this.points);
    this.points.set(event.pointerId, at);
    if (this.kind === 'pinch' && this.points.size === 2) {
      this.pinch([...previous.values()], [...this.points.values()]);
    } else if (this.kind === 'scrub') {
      this.scrub(at);
    } else if (this.kind === 'choose') {
      this.timeline.showTip(at.x, at.time);
      this.timeline.choose(at.time);
    } else if (this.kind === 'loop' && Math.abs(at.x - this.origin.x) > MIN_DRAG) {
      this.drawn = { from: Math.min(at.time, this.origin.time), to: Math.max(at.time, this.origin.time) };
      this.timeline.showTip(at.x, at.time);
      this.timeline.redraw();
    } else if (this.kind === 'edge') {
      this.dragEdge(at);
    }
  }

  dragEdge(at) {
    const other = this.edge === 'from' ? 'to' : 'from';
    const fixed = this.timeline.range[other];
    this.drawn = { from: Math.min(at.time, fixed), to: Math.max(at.time, fixed) };
    this.edge = at.time <= fixed ? 'from' : 'to';
    this.timeline.showTip(at.x, at.time);
    this.timeline.redraw();
  }

  hover(at) {
    this.timeline.showTip(at.x, at.time);
    this.track.classList.toggle('over-edge', this.timeline.may && Boolean(this.edgeAt(at)));
    this.track.classList.toggle('over-ruler', this.timeline.may && at.y < RULER);
    store.setCursor(at.time);
  }

  pinch([a, b], [c, d]) {
    const before = Math.max(10, Math.abs(a.x - b.x));
    const after = Math.max(10, Math.abs(c.x - d.x));
    this.timeline.pan((a.x + b.x) / 2 - (c.x + d.x) / 2);
    this.timeline.zoom(before / after, (c.x + d.x) / 2);
  }

  async up(event) {
    if (!this.points.delete(event.pointerId)) {
      return;
    }
    const { kind, drawn, scrubbing, origin } = this;
    this.kind = this.points.size ? this.kind : null;
    if (kind === 'scrub' && scrubbing !== null) {
      this.timeline.seek(scrubbing);
      this.scrubbing = null;
      this.timeline.showTip(null);
    } else if (kind === 'loop' && !drawn) {
      this.timeline.seek(origin.time);
    } else if ((kind === 'loop' || kind === 'edge') && drawn) {
      await this.timeline.setLoop(drawn);
      this.drawn = null;
      this.timeline.redraw();
    }
    event.pointerType === 'touch' && this.left();
  }

  cancel(event) {
    this.points.delete(event.pointerId);
    this.kind = null;
    this.scrubbing = null;
    this.drawn = null;
    this.left();
    this.timeline.redraw();
  }

  wheel(event) {
    event.preventDefault();
    const sideways = Math.abs(event.deltaX) > Math.abs(event.deltaY) || event.shiftKey;
    const lines = event.deltaMode === 1 ? 16 : 1;
    if (sideways) {
      this.timeline.pan((event.deltaX || event.deltaY) * lines);
    } else {
      this.timeline.zoom(Math.min(4, Math.max(0.25, Math.exp(event.deltaY * lines * 0.002))), this.at(event).x);
    }
  }
}
