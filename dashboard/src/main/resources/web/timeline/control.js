/** Starts and steers replays. */
import { api } from '../core/api.js';
import { store } from '../core/store.js';

/** Between two jumps while the play head is dragged, ms. */
const SEEK_INTERVAL = 400;
/** After which a replay that was asked for is expected to be played. */
const START_WITHIN = 20_000;

export const SPEEDS = [0.5, 1, 2, 4, 10, 30, 60, 'max'];

/** The path of a replay, or of all that follow its clock. @param {{replay: string, group: string=}} of */
export function pathOf({ replay, group }) {
  return group ? `/api/replays/groups/${encodeURIComponent(group)}` : `/api/replays/${encodeURIComponent(replay)}`;
}

export function steer(of, command, body = {}) {
  return api.post(`${pathOf(of)}/${command}`, body);
}

export function stop(of) {
  return api.del(pathOf(of));
}

/**
 * Asks for a replay and shows it as soon as it is played.
 *
 * @param {Object} plan body of `POST /api/replays`
 * @returns {Promise<string>} its name
 * @throws {import('../core/api.js').ApiError|Error} where it is refused, or nothing plays it
 */
export async function startReplay(plan) {
  const answer = await api.post('/api/replays', plan);
  const name = answer.replay ?? answer.replays?.[0]?.replay ?? answer.replays?.[0];
  const record = await played((each) => (answer.group ? each.group === answer.group : each.replay === name));
  store.enterReplay(record);
  return record.replay;
}

/** Resolves with the first replay that is meant and has a status. */
function played(isMeant) {
  const find = () => [...store.replays.values()].find((each) => isMeant(each) && each.topic && each.status);
  return new Promise((resolve, reject) => {
    let off = () => {};
    const timer = setTimeout(() => {
      off();
      reject(new Error('not-played'));
    }, START_WITHIN);
    const update = () => {
      const found = find();
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

/** Jumps to where the play head is dragged, not more often than the replay can follow; the last one counts. */
export class Seeking {
  /** @param {function(Error)} failed */
  constructor(failed) {
    this.failed = failed;
    this.wanted = null;
    this.busy = false;
  }

  /** @param {number} time epoch ms @returns {Promise} resolves when nothing is to be sought any more */
  to(time, of) {
    this.wanted = Math.round(time);
    return (this.running = this.busy ? this.running : this.run(of));
  }

  async run(of) {
    this.busy = true;
    while (this.wanted !== null) {
      const to = this.wanted;
      this.wanted = null;
      const begun = Date.now();
      try {
        await steer(of, 'seek', { to });
      } catch (error) {
        this.failed(error);
      }
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, SEEK_INTERVAL - (Date.now() - begun))));
    }
    this.busy = false;
  }
}
