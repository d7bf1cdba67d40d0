/** Stops all robots of the farm: asks once, and shows the outcome of each robot. */
import { h, replace } from '../core/dom.js';
import { word } from '../core/format.js';
import { icon } from '../core/icons.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { openDialog } from '../core/dialog.js';
import { commandsOf, outcomeOf, outcomeWords, sendCommand } from './commands.js';

const COMMAND = 'Stop';

export function stopAllButton() {
  const button = h('button.stop-all', { type: 'button', 'aria-label': t('stopAll.title'), title: t('stopAll.title'), on: { click: open } },
    icon('octagon', 18), h('span.stop-all-more', null, t('stopAll.title')), h('span.stop-all-short', null, t('stopAll.short')));
  const allow = () => { button.hidden = !store.may('operate'); };
  store.on('me', allow);
  allow();
  return button;
}

/** Robots of all domains, whatever the scope and the search; without those that the stop of their mission switched off. */
function robots() {
  return [...store.entities.values()].filter((each) => each.state !== 'off' && commandsOf(each).some(({ name }) => name === COMMAND)).sort((a, b) => a.name.localeCompare(b.name, undefined, { numeric: true }));
}

function open() {
  store.leaveReplay(); // what it shows is recorded
  const outcomes = new Map();
  const list = h('ul.stop-list', { tabindex: '0', 'aria-label': t('stopAll.title') });
  const { dialog, action, cancel } = openDialog({
    title: `${t('stopAll.title')}?`, submit: t('stopAll.short'), danger: true, body: [h('p', null, t('stopAll.text')), list],
    work: async () => {
      const others = robots().filter((each) => !outcomes.has(each.id) || outcomeOf(each, outcomes.get(each.id), Date.now()).state !== 'ok');
      await Promise.all(others.map((each) => sendCommand(each, COMMAND, (sent) => { outcomes.set(each.id, sent); draw(); })));
      replace(action, t('stopAll.again'));
      replace(cancel, t('missions.close'));
      return true;
    },
  });
  const draw = () => {
    const all = store.isReplay ? [] : robots();
    replace(list, all.length ? all.map((each) => row(each, outcomes.get(each.id))) : h('li.muted', null, t(store.primed ? 'stopAll.none' : 'cards.loading')));
  };
  const subscriptions = ['entities', 'clock', 'mode'].map((name) => store.on(name, draw));
  dialog.addEventListener('close', () => subscriptions.forEach((unsubscribe) => unsubscribe()));
  draw();
  action.focus();
}

function row(entity, sent) {
  const { text, kind } = sent ? outcomeWords(entity, sent) : { text: [entity.word && word(entity.word, 'reported'), entity.state === 'stale' && t('states.stale')].filter(Boolean).join(', '), kind: 'muted' };
  return h('li.row', { data: { id: entity.identity.id } }, h('strong', null, entity.name), h('span.muted.cut', null, entity.mission ?? entity.domain), h('span.spacer'), h(`span.card-outcome.numbers.${kind || 'muted'}`, null, text));
}
