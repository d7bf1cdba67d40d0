/** The columns of a report's tables, on the page and as CSV. */
import { sentenceOf } from '../../alarms/sentence.js';
import { dateOf } from '../../core/csv.js';
import { h } from '../../core/dom.js';
import { area, dateTime, duration, label, number, percent, shortId, temperature, word } from '../../core/format.js';
import { numberColumn, textColumn } from '../../core/table.js';
import { t } from '../../texts.js';
import { COLUMNS as RESULTS } from '../analyses/columns.js';

function timeColumn(name, of) {
  return { name, value: (row) => dateOf(of(row)), words: (row) => dateTime(of(row)) };
}

/** With gaps and overlap as far as they are reported. */
const coverages = [
  textColumn('report.field', ({ fieldName }) => fieldName),
  numberColumn('report.hectares', 'hectare', ({ figures }) => figures.hectares, area),
  numberColumn('report.fieldHectares', 'hectare', ({ figures }) => figures.fieldHectares, area),
  { name: 'report.share', unit: 'percent', value: ({ figures }) => Math.round(10_000 * figures.share) / 100, words: ({ figures }) => percent(figures.share), isNumber: true },
  numberColumn('report.overlap', 'hectare', ({ figures }) => figures.overlap, area),
  numberColumn('report.gaps', 'hectare', ({ figures }) => figures.gaps, area),
  timeColumn('report.from', ({ figures }) => figures.start),
  timeColumn('report.to', ({ figures }) => figures.end),
];

const averages = [
  textColumn('report.field', ({ name }) => name),
  numberColumn('report.mean', 'celsius', ({ mean }) => mean, temperature),
  numberColumn('report.min', 'celsius', ({ min }) => min, temperature),
  numberColumn('report.max', 'celsius', ({ max }) => max, temperature),
  { name: 'report.windows', value: ({ windows }) => windows, words: ({ windows }) => number(windows), isNumber: true },
  textColumn('report.suspects', ({ suspects }) => suspects.map((id) => shortId(id)).join(', ') || t('analyses.none')),
];

const alarms = [
  timeColumn('report.when', ({ raised }) => raised),
  textColumn('report.severity', ({ severity }) => word(severity ?? '')),
  textColumn('report.alarm', sentenceOf),
  { name: 'report.times', value: ({ count }) => count ?? 1, words: ({ count }) => number(count ?? 1), isNumber: true },
  { name: 'report.open', unit: 'second', value: lasted, words: (alarm) => (alarm.state === 'closed' ? duration(1000 * lasted(alarm)) : t('report.stillOpen')), isNumber: true },
];

const markers = [timeColumn('report.when', ({ time }) => time), textColumn('report.note', ({ note }) => note), textColumn('report.author', ({ author }) => author ?? '')];

const devices = [
  textColumn('report.device', ({ id }) => shortId(id)),
  { name: 'report.id', value: ({ id }) => id },
  textColumn('report.type', ({ type }) => type || '–'),
  textColumn('report.state', ({ state }) => (state ? label(word(state, 'reported')) : '–')),
  numberColumn('report.hectares', 'hectare', ({ hectares }) => hectares, area),
  numberColumn('report.overlap', 'hectare', ({ overlap }) => overlap, area),
  { name: 'report.late', unit: 'second', value: ({ late }) => (late === null ? null : late / 1000), words: ({ late }) => (late === null ? '–' : h('span.warn', { title: t('report.lateHint') }, duration(late))), isNumber: true },
];

const runs = [
  timeColumn('report.from', ({ from }) => from),
  timeColumn('report.to', ({ to }) => to),
  { name: 'report.length', unit: 'second', value: ({ from, to }) => (to - from) / 1000, words: ({ from, to }) => duration(to - from), isNumber: true },
];

export const COLUMNS = { runs, coverages, encounters: RESULTS.encounters.map((each) => (each.name === 'analyses.when' ? timeColumn(each.name, ({ start }) => start) : each)), averages, alarms, markers, devices };

function lasted({ state, raised, changed }) {
  return state === 'closed' ? (changed - raised) / 1000 : null;
}
