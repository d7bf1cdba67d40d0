/** The dialog for a marker. */
import { h } from '../core/dom.js';
import { dateTime } from '../core/format.js';
import { t } from '../texts.js';
import { formRow, openDialog } from '../core/dialog.js';
import { addMarker } from './moments.js';

/**
 * Opens a dialog that adds a marker with a note.
 *
 * @param {string} mission @param {number} time epoch ms @param {{added: function(), closed: function()}} callbacks
 */
export function openMarker(mission, time, { added, closed }) {
  const note = h('input', { type: 'text', maxlength: 1000, required: true, autocomplete: 'off' });
  const { dialog } = openDialog({
    title: t('timeline.markTitle'), submit: t('timeline.markSave'), body: [h('p.muted', null, `${mission} · ${dateTime(time)}`), formRow(t('timeline.markNote'), note)],
    work: async () => {
      await addMarker(mission, time, note.value.trim());
      added();
    },
  });
  dialog.addEventListener('close', closed);
  note.focus();
}
