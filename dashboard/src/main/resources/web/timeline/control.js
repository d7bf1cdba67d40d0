/** Starts and controls replays. */
import { api } from '../core/api.js';
import { store } from '../core/store.js';

/** Minimum interval between two seeks while the play head is dragged, ms. */
const SEEK_INTERVAL = 400;
/** Time within which a requested replay is expected to start, ms. */
const START_TIMEOUT = 20_000;
/** Accepted difference between a requested position and the reported one, ms. */
export const SEEK_TOLERANCE = 1_500;

export const SPEEDS = [0.5, 1, 2, 4, 10, 30, 60, 'max'];

/** The path of a replay, or of its group, which shares a clock. @param {{replay: string, group: string=}} replay */
function pathOf({ replay, group }) {
  return group ? `/api/replays/groups/${encodeURIComponent(group)}` : `/api/replays/${encodeURIComponent(replay)}`;
}

export function steer(replay, command, body = {}) {
  return api.post(`${pathOf(replay)}/${command}`, body);
}

export function stop(replay) {
  return api.del(pathOf(replay));
}

/**
 * Requests a replay and shows it once it is played.
 *
 * @param {Object} plan body of `POST /api/replays`
 * @param {number|null=} at where it begins, epoch ms; sought before it is played, so that its beginning is not shown
 * @returns {Promise<string>} its name
 * @throws {import('../core/api.js').ApiError|Error} if it is rejected, or no job plays it
 */
export async function startReplay(plan, at = null) {
  const answer = await api.post('/api/replays', plan);
  const name = answer.replay ?? answer.replays?.[0]?.replay ?? answer.replays?.[0];
  at === null || await steer({ replay: name, group: answer.group }, 'seek', { to: Math.round(at) });
  const record = await played((each) => (answer.group ? each.group === answer.group : each.replay === name), at);
  store.enterReplay(record);
  return record.replay;
}

/** Resolves with the first replay that matches, has a status and has reached the time. */
function played(isRequested, at) {
  const find = (from) => [...store.replays.values()].find((each) => isRequested(each) && each.topic && each.status && (from === null || each.status.progress?.position >= from - SEEK_TOLERANCE));
  return new Promise((resolve, reject) => {
    let off = () => {};
    const timer = setTimeout(() => {
      off();
      const late = find(null);
      late ? resolve(late) : reject(new Error('not-played'));
    }, START_TIMEOUT);
    const update = () => {
      const found = find(at);
      if (found) {
        clearTimeout(timer);
        off();
        resolve(found);
      }
    };
    off = store.on('replays', update);
    update();
  });
}

/** Seeks to the dragged play head, no more often than the replay can follow; the last position counts. */
export class Seeking {
  /** @param {function(Error)} failed */
  constructor(failed) {
    this.failed = failed;
    this.target = null;
    this.busy = false;
  }

  /** @param {number} time epoch ms @returns {Promise} resolves when no seek is pending */
  to(time, replay) {
    this.target = Math.round(time);
    return (this.running = this.busy ? this.running : this.run(replay));
  }

  async run(replay) {
    this.busy = true;
    while (this.target !== null) {
      const to = this.target;
      this.target = null;
      const startedAt = Date.now();
      try {
        await steer(replay, 'seek', { to });
      } catch (error) {
        this.failed(error);
      }
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, SEEK_INTERVAL - (Date.now() - startedAt))));
    }
    this.busy = false;
  }
}
