/** Describes the connection of a device in sentences. */
import { dateTime, duration } from '../core/format.js';
import { t } from '../texts.js';

/** @param {object} connection of the REST API @returns {string[]} */
export function sentencesOf({ since, loggedIn, refusedLogin, foreignTopic, unreadablePayload, registered, lastReport } = {}) {
  const sentences = [];
  const add = (name, values) => sentences.push(t(`cards.connection.${name}`, values));
  const observed = ({ count, last }) => ({ times: t(`cards.connection.${count === 1 ? 'once' : 'times'}`, { count }), time: dateTime(last) });
  if (lastReport) {
    const { time, offset } = lastReport;
    add(offset < 0 ? 'ahead' : 'report', { time: dateTime(time), offset: duration(Math.abs(offset)) });
  }
  if (registered === false) {
    add('unregistered');
  }
  if (loggedIn) {
    add('login', { time: dateTime(loggedIn) });
  } else if (since) {
    add('noLogin', { time: dateTime(since) });
  }
  if (refusedLogin) {
    add(refusedLogin.reason === 'unknown-user' ? 'user' : 'password', { ...refusedLogin, ...observed(refusedLogin) });
  }
  if (foreignTopic) {
    add('foreign', { ...foreignTopic, ...observed(foreignTopic) });
  }
  if (unreadablePayload) {
    add('unreadable', { ...unreadablePayload, time: dateTime(unreadablePayload.last) });
  }
  return sentences;
}
