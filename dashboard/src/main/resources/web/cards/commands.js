/** Commands of a device and their outcomes. */
import { api } from '../core/api.js';
import { isStopped } from '../core/entity.js';
import { duration, word } from '../core/format.js';
import { isOfCommand } from '../core/readings.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';

const ROBOT = ['Stop', 'Resume'];
const DEVICE = ['on', 'off', 'restart'];
/** Commands that require a confirmation. */
const RISKY = new Set(['restart', 'off', 'Running']);
/** Time after which a missing answer is reported, ms. */
const ANSWER_TIMEOUT = 30_000;
/** Characters of a result that are shown. */
const MAX_INFO = 120;

/**
 * The commands of a device, at most 6.
 *
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
  for (const [name, attribute] of Object.entries(entity.attributes)) {
    const command = isOfCommand(name, attribute) && /^([A-Za-z][\w-]{0,63})_(status|info)$/.exec(name)?.[1];
    if (command && command !== 'cmd' && !DEVICE.includes(command)) {
      names.add(command);
    }
  }
  return [...names].slice(0, 6).map((name) => ({ name, primary: name === 'Stop' && !isStopped(entity) && entity.state !== 'off', risky: RISKY.has(name) }));
}

/** Whether the command would have no effect. */
export function isPointless(entity, command) {
  return (command === 'Stop' && isStopped(entity)) || (command === 'Resume' && /^running$/i.test(entity.word ?? ''));
}

/**
 * The outcome of a command sent from this page. The status may stay PENDING although the info has the answer.
 *
 * @param {import('../core/entity.js').Entity} entity
 * @param {{command: string, at: number, info: string|null, waiting: boolean}} sent `info`: the attribute's previous value as text; `waiting`: for the server's response
 * @param {number} now epoch ms of the clock, also in a replay
 * @returns {{state: 'pending'|'ok'|'failed'|'unanswered', info: string|null}}
 */
export function outcomeOf(entity, sent, now) {
  const prefix = `${sent.command}_status` in entity.attributes ? sent.command : 'cmd';
  const status = String(entity.attributes[`${prefix}_status`]?.value ?? '').toUpperCase();
  const info = text(entity.attributes[`${prefix}_info`]?.value);
  const reported = !sent.waiting && entity.heard >= sent.at;
  if (reported && (status === 'ERROR' || status === 'EXPIRED' || status === 'FAILED')) {
    return { state: 'failed', info };
  }
  const answered = reported && (status === 'OK' || status === 'DELIVERED' || status === 'FINISHED' || (info !== null && info !== sent.info));
  if (answered) {
    return { state: 'ok', info };
  }
  return now - sent.at > ANSWER_TIMEOUT ? { state: 'unanswered', info: null } : { state: 'pending', info: null };
}

/** The outcome in words. @returns {{text: string, kind: 'good'|'bad'|'warn'|''}} */
export function outcomeWords(entity, sent) {
  const { at, error } = sent;
  const command = word(sent.command, 'commands');
  if (error) {
    return { text: t('cards.refused', { command, reason: error }), kind: 'bad' };
  }
  const { state, info } = outcomeOf(entity, sent, Date.now());
  const ago = t('format.ago', { duration: duration(Date.now() - at) });
  return { text: t(`cards.outcomes.${state}`, { command, ago, info: info?.slice(0, MAX_INFO) ?? '' }), kind: { ok: 'good', failed: 'bad', unanswered: 'warn', pending: '' }[state] };
}

/**
 * Sends a command to a device.
 *
 * @param {import('../core/entity.js').Entity} entity
 * @param {string} command
 * @param {function(Object)} changed receives what {@link outcomeOf} takes: when it is sent, and when the server has answered
 */
export async function sendCommand(entity, command, changed) {
  const sent = { command, at: Date.now(), info: infoOf(entity, command), waiting: true };
  changed(sent);
  try {
    await api.post(deviceAt(entity, '/commands'), { command, type: entity.type });
  } catch (error) {
    sent.error = error.message;
  }
  sent.waiting = false;
  changed(sent);
}

/** The device of an entity in the REST API. */
export function deviceAt({ type, identity: { id, service, servicePath } }, command = '') {
  return `/api/devices/${encodeURIComponent(id)}${command}?${new URLSearchParams({ service, servicePath, type })}`;
}

/** The current info, to detect a new one. */
function infoOf(entity, command) {
  return text((entity.attributes[`${command}_info`] ?? entity.attributes.cmd_info)?.value);
}

function text(info) {
  return info === undefined || info === null || info === '' ? null : typeof info === 'object' ? JSON.stringify(info) : String(info);
}
