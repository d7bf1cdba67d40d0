/** Shows the findings of a check as a list of devices. */
import { duration, shortId } from '../../core/format.js';
import { h } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { t } from '../../texts.js';

const WORST_FIRST = ['problem', 'warning', 'unknown', 'ok'];
const SYMBOLS = { ok: 'check', unknown: 'info', warning: 'warning', problem: 'close' };

/** @param {ReturnType<import('./check.js').checkPlan>} checked */
export function findingsList(checked) {
  return h('ul.findings', { 'aria-label': t('missions.check') }, [...checked].sort((a, b) => WORST_FIRST.indexOf(a.worst) - WORST_FIRST.indexOf(b.worst)).map((device) => h('li', { class: `finding is-${device.worst}` },
    icon(SYMBOLS[device.worst], 18),
    h('div', null,
      h('strong', null, shortId(device.name) || t('missions.unnamed')),
      h('span.visually-hidden', null, ` ${t(`missions.levels.${device.worst}`)}`),
      h('ul.small', null, device.findings.map((each) => h('li', { class: `is-${each.level}` }, sentence(each))))))));
}

function sentence({ text, values }) {
  return t(`missions.findings.${text}`, { ...values, ago: values.ago === undefined ? '' : duration(values.ago) });
}

/** Summarizes a check; problems come first. */
export function summaryOf(checked) {
  const count = (level) => checked.filter((each) => each.worst === level).length;
  const [problems, bad] = [count('problem'), count('warning')];
  if (problems) {
    return t(bad ? 'missions.checkProblemMore' : 'missions.checkProblem', { problems, bad, count: checked.length });
  }
  return bad ? t('missions.checkBad', { bad, count: checked.length }) : t('missions.checkGood', { count: checked.length });
}
