/** Opens dialogs with a form, its failure and its buttons. */
import { h, replace } from './dom.js';
import { icon } from './icons.js';
import { t } from '../texts.js';
import { focusAct } from './redraw.js';

/**
 * Opens a dialog.
 *
 * @param {{title: string, body: Node[], submit: string, danger: boolean=, work: function(): Promise<boolean|void>}} options `work` throws errors to
 *     be shown, and returns true if the dialog stays open
 */
export function openDialog({ title, body, submit, danger = false, work }) {
  const failure = h('div', { role: 'alert' });
  const action = h('button.button', { type: 'submit', class: danger ? 'danger' : 'primary' }, submit);
  const cancel = h('button.button', { type: 'button', on: { click: () => dialog.close() } }, t('missions.cancel'));
  const dialog = h('dialog.sheet', { 'aria-label': title });
  const opener = document.activeElement;
  const send = async (event) => {
    event.preventDefault();
    action.disabled = true;
    replace(failure);
    try {
      if (await work() !== true) {
        dialog.close();
      }
    } catch (error) {
      replace(failure, h('p.error-note', null, icon('warning'), error.message));
    } finally {
      action.disabled = false;
    }
  };
  replace(dialog, h('form', { on: { submit: send } },
    h('header', null, h('h2', null, title), h('button.button.quiet.square', { type: 'button', 'aria-label': t('missions.close'), on: { click: () => dialog.close() } }, icon('close'))),
    body, failure,
    h('footer', null, cancel, action)));
  dialog.addEventListener('close', () => {
    dialog.remove();
    opener?.isConnected ? opener.focus() : focusAct(document, opener?.dataset?.act);
  });
  document.body.append(dialog);
  dialog.showModal();
  return { dialog, action, cancel };
}

export function formRow(words, input, hint) {
  input.id ||= `field-${Math.random().toString(36).slice(2)}`;
  return h('div.field-row', null, h('label', { for: input.id }, words), input, hint && h('p.small.muted', null, hint));
}
