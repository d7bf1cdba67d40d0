/** Streams the records of topics over WebSockets. */
import { api } from './api.js';
import { exists } from './existing.js';
import { parse } from './json.js';

const MIN_BACKOFF = 500;
const MAX_BACKOFF = 15_000;
/** Interval at which a topic that is created with its first record is looked for, ms. */
const CREATED_INTERVAL = 3_000;
/** Time for which a hidden tab retains its streams, in case the user returns; streams needed `whileHidden` stay open. */
const HIDDEN_AFTER = 10_000;
/** Number of streams that are opened at a time, in the order of subscription: what is shown first does not wait for the work of all others. */
const OPENED_AT_A_TIME = 3;
/** Time after which a stream that is being opened no longer delays others, ms. */
const OPENING_TIMEOUT = 1_000;

let opening = 0;
const waiting = [];
/** Streams that wait for another attempt. When one stream is open again, all try at once: what each has missed is then known at the same time. */
const retrying = new Set();

/** Begins to open a stream. @returns {function()} to be called when it is open, or has failed */
function startOpening() {
  opening++;
  let isOver = false;
  const end = () => {
    if (!isOver) {
      isOver = true;
      clearTimeout(timeout);
      opening--;
      waiting.shift()?.();
    }
  };
  const timeout = setTimeout(end, OPENING_TIMEOUT);
  return end;
}

/**
 * A record of a topic.
 *
 * @typedef {Object} TopicRecord
 * @property {string} topic
 * @property {'event'|'prime'} kind `prime`: part of the initial state
 * @property {string|null} key
 * @property {number} time the record's timestamp: event time, epoch ms
 * @property {number=} sequence number within the topic; a jump is a gap
 * @property {Object<string, string>} headers
 * @property {*} value null for a deletion
 * @property {number=} cut bytes of a value that was too large to be sent
 */

class Stream {
  constructor(topic, options, handlers) {
    this.topic = topic;
    this.query = new URLSearchParams({ mode: options.mode ?? 'all', prime: String(options.prime ?? true), format: 'record' });
    this.handlers = handlers;
    this.state = 'connecting';
    this.backoff = MIN_BACKOFF;
    this.sequence = null;
    this.isPrimed = options.prime ?? true;
    this.opened = () => {};
    /** Resolves when the socket is requested, or has failed. */
    this.requested = new Promise((resolve) => (this.onRequested = resolve));
    this.isCreatedLater = options.createdLater ?? false;
    this.whileHidden = options.whileHidden ?? (() => false);
    this.hidden = document.hidden && !this.whileHidden();
    this.onVisibility = () => this.visibility();
    document.addEventListener('visibilitychange', this.onVisibility);
    if (!this.hidden) {
      this.connect();
    } else {
      this.report('paused');
    }
  }

  visibility() {
    clearTimeout(this.hiding);
    if (document.hidden) {
      this.hiding = setTimeout(() => this.whileHidden() || this.pause(), HIDDEN_AFTER);
    } else if (this.hidden) {
      this.hidden = false;
      this.connect();
    }
  }

  pause() {
    this.hidden = true;
    this.sequence = null;
    this.disconnect();
    this.report('paused');
  }

  async connect() {
    if (this.closed || this.hidden) {
      return;
    }
    clearTimeout(this.retry);
    retrying.delete(this);
    const attempt = (this.attempt = Symbol('attempt'));
    this.report('connecting');
    if (opening >= OPENED_AT_A_TIME) {
      await new Promise((begin) => waiting.push(begin));
      if (this.attempt !== attempt) {
        waiting.shift()?.();
        return;
      }
    }
    this.opened = startOpening();
    try {
      if (this.isCreatedLater && !(await exists(this.topic))) {
        this.attempt === attempt && this.failed(null, CREATED_INTERVAL);
        return;
      }
      const answer = await api.get(`/api/register/${encodeURIComponent(this.topic)}?${this.query}`);
      if (this.closed || this.attempt !== attempt) {
        return;
      }
      this.open(answer.socket);
    } catch (error) {
      if (this.attempt === attempt) {
        this.failed(error);
      }
    }
  }

  open(path) {
    this.onRequested();
    const url = new URL(path, location.href);
    url.protocol = url.protocol.replace('http', 'ws');
    const socket = (this.socket = new WebSocket(url));
    socket.onopen = () => {
      this.backoff = MIN_BACKOFF;
      this.isFirst = true;
      this.isPrimed || this.opened();
      this.report('open');
      [...retrying].forEach((each) => each.connect());
    };
    socket.onmessage = (message) => this.receive(parse(message.data));
    socket.onclose = (event) => {
      if (this.socket === socket) {
        this.socket = null;
        this.failed(event.reason ? new Error(event.reason) : null);
      }
    };
  }

  receive(frame) {
    if (frame.records) {
      const missed = frame.records.reduce((sum, record) => sum + this.missedBefore(record), 0);
      missed && this.handlers.gap?.(missed);
      this.handlers.records?.(frame.records, frame.merged ?? 0);
    } else if (frame.primed) {
      this.opened();
      this.handlers.primed?.();
    }
  }

  /** The number of records missing before this one. After a lost connection it is unknown, as the server may restart its sequence. */
  missedBefore({ sequence }) {
    if (sequence === undefined) {
      return 0;
    }
    const missed = this.sequence !== null && this.query.get('mode') === 'all' ? Math.max(0, sequence - this.sequence - 1) : 0;
    this.sequence = this.isFirst ? sequence : Math.max(sequence, this.sequence);
    this.isFirst = false;
    return missed;
  }

  /** @param {Error|null} error @param {number=} interval until a topic that does not exist is looked for again, ms */
  failed(error, interval = null) {
    if (this.closed || this.hidden) {
      return;
    }
    this.opened();
    this.onRequested();
    // retries a rejected request rarely: the topic may be created, or the role may change
    const rejected = interval !== null || error?.status === 403 || error?.status === 404;
    this.report(rejected ? 'refused' : 'waiting', error?.message);
    const backoff = interval ?? (rejected ? MAX_BACKOFF : this.backoff);
    this.backoff = Math.min(MAX_BACKOFF, this.backoff * 2);
    rejected || retrying.add(this);
    this.retry = setTimeout(() => this.connect(), backoff * (0.75 + Math.random() / 2));
  }

  report(state, reason) {
    this.state = state;
    this.handlers.state?.(state, reason);
  }

  disconnect() {
    clearTimeout(this.retry);
    retrying.delete(this);
    this.attempt = null;
    this.opened();
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }

  close() {
    this.closed = true;
    clearTimeout(this.hiding);
    document.removeEventListener('visibilitychange', this.onVisibility);
    this.disconnect();
  }
}

export const streams = {
  /**
   * Subscribes to a topic. Reconnects by itself, and then receives the initial state again.
   *
   * @param {string} topic
   * @param {{mode: ('all'|'latest')=, prime: boolean=, createdLater: boolean=, whileHidden: (function(): boolean)=}} options `createdLater`: the topic may not
   *     exist yet
   * @param {{records: function(TopicRecord[], number)=, primed: function()=, state: function(string, string=)=, gap: function(number)=}} handlers
   *     state is `connecting`, `open`, `waiting` (for the next attempt), `refused` or `paused`
   * @returns {{close: function(), state: string, requested: Promise}}
   */
  subscribe(topic, options, handlers) {
    return new Stream(topic, options, handlers);
  },
};
