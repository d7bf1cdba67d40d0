/** Small charts of the events of a mission over time. */
import { api } from '../../core/api.js';
import { h } from '../../core/dom.js';
import { palette, sharp } from '../../timeline/draw.js';

const WIDTH = 168;
const HEIGHT = 28;
const BUCKETS = 56;
const POLL_INTERVAL = 1_500;

/** Loads the chart once, and again while events are being counted. */
export class Preview {
  /** @param {string} mission @param {function()} counted called when the number of events is known */
  constructor(mission, counted) {
    this.mission = mission;
    this.counted = counted;
    this.events = null;
    this.timeline = null;
    this.element = h('canvas.preview', { 'aria-hidden': 'true' });
    this.load();
  }

  /** Reloads if the mission was recorded further. */
  update(last) {
    if (this.timeline && last - this.timeline.last > (this.timeline.width || 1)) {
      this.load();
    }
  }

  async load(attempts = 20) {
    clearTimeout(this.timer);
    try {
      this.timeline = await api.get(`/api/recordings/${encodeURIComponent(this.mission)}/timeline?buckets=${BUCKETS}`);
      this.events = this.timeline.complete ? this.timeline.counts.reduce((sum, count) => sum + count, 0) : null;
      this.draw();
      this.counted();
      if (!this.timeline.complete && attempts > 0) {
        this.timer = setTimeout(() => this.load(attempts - 1), POLL_INTERVAL);
      }
    } catch {
      this.element.hidden = true; // the chart is dispensable
    }
  }

  draw() {
    if (!this.timeline || !this.element.isConnected) {
      return;
    }
    const { counts, from, width, first, last } = this.timeline;
    const colors = palette(this.element);
    const g = sharp(this.element, WIDTH, HEIGHT);
    const highest = Math.max(1, ...counts);
    const per = WIDTH / Math.max(1, last - first);
    g.clearRect(0, 0, WIDTH, HEIGHT);
    g.fillStyle = colors.line;
    g.fillRect(0, HEIGHT - 1, WIDTH, 1);
    g.fillStyle = colors.bar;
    g.globalAlpha = 0.7;
    counts.forEach((count, index) => {
      const left = Math.max(0, (from + index * width - first) * per);
      const right = Math.min(WIDTH, (from + (index + 1) * width - first) * per);
      const barHeight = count ? Math.max(2, (count / highest) * (HEIGHT - 2)) : 0;
      g.fillRect(left, HEIGHT - barHeight, Math.max(1, right - left - 0.75), barHeight);
    });
    g.globalAlpha = 1;
  }

  close() {
    clearTimeout(this.timer);
  }
}
