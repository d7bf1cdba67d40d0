/** Commands of a device, and how the last ones went. */
import { store } from '../core/store.js';

const ROBOT = ['Stop', 'Resume'];
const DEVICE = ['on', 'off', 'restart'];
/** Asked about before they are sent. */
const RISKY = new Set(['restart', 'off', 'Running']);
/** An answer that has not come by then is said to be missing, ms. */
const PATIENCE = 30_000;

/**
 * @param {import('../core/entity.js').Entity} entity
 * @returns {{name: string, primary: boolean, risky: boolean}[]}
 */
export function commandsOf(entity) {
  const names = new Set();
  if ('cmd' in entity.attributes) {
    ROBOT.forEach((each) => names.add(each));
  } else if (store.deviceOf(entity)?.device) {
    const off = entity.word === 'off';
    [off ? 'on' : 'off', 'restart'].forEach((each) => names.add(each));
  }
  for (const name of Object.keys(entity.attributes)) {
    const command = /^([A-Za-z][\w-]{0,63})_(status|info)$/.exec(name)?.[1];
    if (command && command !== 'cmd' && !DEVICE.includes(command)) {
      names.add(command);
    }
  }
  return [...names].slice(0, 6).map((name) => ({ name, primary: name === 'Stop' && !isStopped(entity), risky: RISKY.has(name) }));
}

function isStopped(entity) {
  return /stop/i.test(entity.word ?? '');
}

/** Whether the device would do nothing new. */
export function isPointless(entity, command) {
  return (command === 'Stop' && isStopped(entity)) || (command === 'Resume' && /^running$/i.test(entity.word ?? ''));
}

/**
 * How a command went that was sent from here. The status may stay PENDING while the info has the answer already.
 *
 * @param {import('../core/entity.js').Entity} entity
 * @param {{command: string, at: number, info: *, waiting: boolean}} sent `info`: what the attribute said before; `waiting`: for the server to take it
 * @param {number} now epoch ms, of the clock
 * @returns {{state: 'pending'|'ok'|'failed'|'unanswered', info: string|null}}
 */
export function outcomeOf(entity, sent, now) {
  const prefix = `${sent.command}_status` in entity.attributes ? sent.command : 'cmd';
  const status = String(entity.attributes[`${prefix}_status`]?.value ?? '').toUpperCase();
  const info = entity.attributes[`${prefix}_info`]?.value;
  const reported = !sent.waiting && entity.time >= sent.at;
  if (reported && (status === 'ERROR' || status === 'EXPIRED' || status === 'FAILED')) {
    return { state: 'failed', info: text(info) };
  }
  const answered = reported && (status === 'OK' || status === 'DELIVERED' || status === 'FINISHED' || (info !== undefined && info !== '' && info !== sent.info));
  if (answered) {
    return { state: 'ok', info: text(info) };
  }
  return now - sent.at > PATIENCE ? { state: 'unanswered', info: null } : { state: 'pending', info: null };
}

/** What the info says now, to tell a new one from it. */
export function infoOf(entity, command) {
  return (entity.attributes[`${command}_info`] ?? entity.attributes.cmd_info)?.value;
}

function text(info) {
  return info === undefined || info === null || info === '' ? null : String(info).slice(0, 120);
}
