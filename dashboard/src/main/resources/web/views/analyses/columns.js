/** The columns of the results of analytics, as tables and as CSV. */
import { dateOf } from '../../core/csv.js';
import { clock, dateTime, distance, duration, moment, shortId, temperature } from '../../core/format.js';
import { store } from '../../core/store.js';
import { numberColumn, textColumn } from '../../core/table.js';
import { t, texts } from '../../texts.js';

/** Of {@link import('./data.js').Average}. */
const averages = [
  { name: 'analyses.window', words: (each) => `${clock(each.start)} – ${clock(each.end)}` },
  { name: 'analyses.from', value: (each) => dateOf(each.start) },
  { name: 'analyses.to', value: (each) => dateOf(each.end) },
  textColumn('analyses.field', (each) => each.name),
  numberColumn('analyses.mean', 'celsius', (each) => each.value, temperature),
  numberColumn('analyses.plain', 'celsius', (each) => each.plain, temperature),
  { name: 'analyses.devices', value: (each) => each.devices, words: (each) => String(each.devices ?? '–') },
  { name: 'analyses.suspects', value: suspectsOf, words: (each) => suspectsOf(each) || t('analyses.none') },
  textColumn('analyses.quality', (each) => texts.analyses.qualities[each.quality] ?? each.quality),
];

/** Of {@link import('../../timeline/moments.js').Encounter}. */
const encounters = [
  { name: 'analyses.when', value: (each) => dateOf(each.start), words: (each) => moment(each.start) },
  textColumn('analyses.pair', (each) => each.pair),
  numberColumn('analyses.closest', 'meter', (each) => each.closest, distance),
  { name: 'analyses.duration', unit: 'second', value: (each) => (each.end - each.start) / 1000, words: (each) => duration(each.end - each.start), isNumber: true },
  textColumn('analyses.phase', (each) => t(`analyses.phases.${each.phase}`)),
];

/** Of stays. */
const presence = [
  textColumn('analyses.field', (each) => each.fieldName),
  textColumn('analyses.device', (each) => each.name),
  { name: 'analyses.entered', value: (each) => dateOf(each.from), words: (each) => dateTime(each.from) },
  { name: 'analyses.left', value: (each) => (each.to === null ? null : dateOf(each.to)), words: (each) => (each.to === null ? t('analyses.stillIn') : dateTime(each.to)) },
  { name: 'analyses.stayed', unit: 'second', value: (each) => stayed(each) / 1000, words: (each) => duration(stayed(each)) },
];

export const COLUMNS = { averages, encounters, presence };

function suspectsOf({ suspects }) {
  return suspects.map((id) => store.entities.get(id)?.name ?? shortId(id)).join(', ');
}

function stayed({ from, to }) {
  return (to ?? store.now()) - from;
}
