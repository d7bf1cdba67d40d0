/** How a device is connected, in sentences. */
import { dateTime, duration } from '../core/format.js';
import { t } from '../texts.js';

/** @param {object} connection as the REST API has it @returns {string[]} */
export function sentencesOf({ since, loggedIn, refusedLogin, foreignTopic, unreadablePayload, registered, lastReport } = {}) {
  const sentences = [];
  const say = (name, values) => sentences.push(t(`cards.connection.${name}`, values));
  const observed = ({ count, last }) => ({ times: t(`cards.connection.${count === 1 ? 'once' : 'times'}`, { count }), time: dateTime(last) });
  if (lastReport) {
    const { time, offset } = lastReport;
    say(offset < 0 ? 'ahead' : 'report', { time: dateTime(time), offset: duration(Math.abs(offset)) });
  }
  if (registered === false) {
    say('unregistered');
  }
  if (loggedIn) {
    say('login', { time: dateTime(loggedIn) });
  } else if (since) {
    say('noLogin', { time: dateTime(since) });
  }
  if (refusedLogin) {
    say(refusedLogin.reason === 'unknown-user' ? 'user' : 'password', { ...refusedLogin, ...observed(refusedLogin) });
  }
  if (foreignTopic) {
    say('foreign', { ...foreignTopic, ...observed(foreignTopic) });
  }
  if (unreadablePayload) {
    say('unreadable', { ...unreadablePayload, time: dateTime(unreadablePayload.last) });
  }
  return sentences;
}
