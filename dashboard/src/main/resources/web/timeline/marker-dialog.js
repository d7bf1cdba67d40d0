/** The dialog for markers. */
import { h } from '../core/dom.js';
import { clock, dateTime } from '../core/format.js';
import { icon } from '../core/icons.js';
import { t } from '../texts.js';
import { formRow, openDialog } from '../core/dialog.js';
import { addMarker, removeMarker } from './moments.js';

/**
 * Opens a dialog that adds a marker with a note, and lists the others, each with a button that deletes it.
 *
 * @param {{mission: string, time: number, markers: Object[]}} moment epoch ms @param {{changed: function(), closed: function()}} callbacks
 */
export function openMarker({ mission, time, markers }, { changed, closed }) {
  const note = h('input', { type: 'text', maxlength: 1000, required: true, autocomplete: 'off' });
  const { dialog } = openDialog({
    title: t('timeline.markTitle'), submit: t('timeline.markSave'),
    body: [h('p.muted', null, `${mission} · ${dateTime(time)}`), formRow(t('timeline.markNote'), note), markers.length > 0 && h('ul.marker-list', null, markers.map((each) => row(each, changed)))],
    work: async () => {
      await addMarker(mission, time, note.value.trim());
      changed();
    },
  });
  dialog.addEventListener('close', closed);
  note.focus();
}

function row(marker, changed) {
  const words = t('timeline.markDelete', { note: marker.note });
  const element = h('li.row', null, h('span.numbers.muted', null, clock(marker.time)), h('span.marker-note', null, marker.note), h('span.spacer'),
    h('button.button.quiet.square.small', { type: 'button', 'aria-label': words, title: words, on: { click: () => openDialog({
      title: `${words}?`, submit: t('missions.delete'), danger: true, body: [],
      work: async () => {
        await removeMarker(marker);
        element.remove();
        changed();
      },
    }) } }, icon('trash', 18)));
  return element;
}
