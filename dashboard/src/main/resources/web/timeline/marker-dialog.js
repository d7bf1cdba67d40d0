/** The dialog for a marker. */
import { h, replace } from '../core/dom.js';
import { dateTime } from '../core/format.js';
import { icon } from '../core/icons.js';
import { t } from '../texts.js';
import { addMarker } from './moments.js';

/**
 * Opens a dialog that adds a marker with a note.
 *
 * @param {string} mission @param {number} time epoch ms @param {{added: function(), closed: function()}} callbacks
 */
export function openMarker(mission, time, { added, closed }) {
  const note = h('input', { type: 'text', id: 'tl-marker', maxlength: 1000, required: true, autocomplete: 'off' });
  const failed = h('p.error-note', { role: 'alert', hidden: true });
  const dialog = h('dialog.sheet', { 'aria-label': t('timeline.markTitle') },
    h('form', { method: 'dialog', on: { submit: (event) => { event.preventDefault(); save(); } } },
      h('h2', null, t('timeline.markTitle')),
      h('p.muted', null, `${mission} · ${dateTime(time)}`),
      h('div.field-row', null, h('label', { for: 'tl-marker' }, t('timeline.markNote')), note), failed,
      h('footer', null, h('button.button', { type: 'button', on: { click: () => dialog.close() } }, t('timeline.cancel')), h('button.button.primary', { type: 'submit' }, t('timeline.markSave')))));
  const save = async () => {
    try {
      await addMarker(mission, time, note.value.trim());
      dialog.close();
      added();
    } catch (error) {
      replace(failed, icon('warning', 18), error.message);
      failed.hidden = false;
    }
  };
  dialog.addEventListener('close', () => { dialog.remove(); closed(); });
  document.body.append(dialog);
  dialog.showModal();
  note.focus();
}
