/** Topics as streams of records, over WebSockets. */
import { api } from './api.js';
import { parse } from './json.js';

const FIRST_WAIT = 500;
const MAX_WAIT = 15_000;
/** A hidden tab keeps its streams for as long, since many are only looked away from; those that are needed `whileHidden` stay. */
const HIDDEN_AFTER = 10_000;

/**
 * @typedef {Object} TopicRecord
 * @property {string} topic
 * @property {'event'|'prime'} kind `prime`: known before the stream began
 * @property {string|null} key
 * @property {number} time the record's timestamp: event time, epoch ms
 * @property {number=} sequence counts the records of the topic; a jump is a gap
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
    this.wait = FIRST_WAIT;
    this.sequence = null;
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
    const attempt = (this.attempt = Symbol('attempt'));
    this.report('connecting');
    try {
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
    const url = new URL(path, location.href);
    url.protocol = url.protocol.replace('http', 'ws');
    const socket = (this.socket = new WebSocket(url));
    socket.onopen = () => {
      this.wait = FIRST_WAIT;
      this.isFirst = true;
      this.report('open');
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
      this.handlers.primed?.();
    } else if (frame.status === 'error') {
      this.handlers.refused?.(frame.reason ?? frame.error);
    }
  }

  /** How many records are missing between the one before and this. After a lost connection the server may count anew, then that is not known. */
  missedBefore({ sequence }) {
    if (sequence === undefined) {
      return 0;
    }
    const missed = this.sequence !== null && this.query.get('mode') === 'all' ? Math.max(0, sequence - this.sequence - 1) : 0;
    this.sequence = this.isFirst ? sequence : Math.max(sequence, this.sequence);
    this.isFirst = false;
    return missed;
  }

  failed(error) {
    if (this.closed || this.hidden) {
      return;
    }
    // what is refused for good is asked for again rarely: a topic may come, a role may change
    const forGood = error?.status === 403 || error?.status === 404;
    this.report(forGood ? 'refused' : 'waiting', error?.message);
    const wait = forGood ? MAX_WAIT : this.wait;
    this.wait = Math.min(MAX_WAIT, this.wait * 2);
    this.retry = setTimeout(() => this.connect(), wait * (0.75 + Math.random() / 2));
  }

  report(state, reason) {
    this.state = state;
    this.handlers.state?.(state, reason);
  }

  disconnect() {
    clearTimeout(this.retry);
    this.attempt = null;
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
   * @param {string} topic
   * @param {{mode: ('all'|'latest')=, prime: boolean=, whileHidden: (function(): boolean)=}} options
   * @param {{records: function(TopicRecord[], number)=, primed: function()=, state: function(string, string=)=,
   *     gap: function(number)=, refused: function(string)=}} handlers state is `connecting`, `open`, `waiting` (for the next attempt), `refused` or `paused`
   * @returns {{close: function(), state: string}} connects again by itself, and then tells once more what is known
   */
  subscribe(topic, options, handlers) {
    return new Stream(topic, options, handlers);
  },
};
