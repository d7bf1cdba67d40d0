/** The sentence of an alarm in the language of the page. */
import { distancesOf, encounterOf, isOver } from '../core/encounter.js';
import { distance, duration, moment, readable, shortId } from '../core/format.js';
import { store } from '../core/store.js';
import { fill, t, texts } from '../texts.js';
import { entitiesOf } from './entities.js';

const GROUPS = [['mission', 'urn:ngsi-ld:Mission:'], ['domain', 'urn:ngsi-ld:Domain:'], ['field', 'Analytics:FieldTemperature:']];
const MAX_NAMED = 4;
const MAX_DETAIL = 1_000;

/** Returns the server's sentence with readable names, or one made of the alarm's values if the language has it. */
export function sentenceOf(alarm) {
  const sentence = own(alarm) ?? readable(alarm.text).replace(/\bfield ([\w-]+)/g, (words, id) => store.fields.get(id)?.name ?? words);
  return sentence.replace(/(\d) (m|s|min|h|°C|%)(?![\w])/g, '$1\u00a0$2');
}

/** Whether the sentence is the server's, in English. */
export function isOfServer(alarm) {
  return own(alarm) === null;
}

/** What a detail of an alarm, or of a missing device, says in the language of the page; null if it has no words for it. @param {{code: string, values: Object}} detail */
export function detailOf({ code, values = {} }) {
  return texts.details && Object.hasOwn(texts.details, code) ? readable(fill(texts.details[code], { ...values, time: moment(Number(values.time)) }), MAX_DETAIL) : null;
}

/** The sentence of a collision has the distances that the map shows; without the encounter, the smallest that the server knew. */
function ofCollision(alarm) {
  const [first, second] = entitiesOf(alarm);
  const encounter = second && encounterOf(first.id, second.id);
  const { now, closest } = encounter && encounter.phase !== 'predicted' ? distancesOf(encounter) : { closest: alarm.values?.meters };
  const names = alarm.devices.map(({ id }) => shortId(id));
  return Number.isFinite(closest) && names.length === 2
    ? t(Number.isFinite(now) && !isOver(encounter) ? 'alarms.apart' : 'alarms.within', { first: names[0], second: names[1], now: distance(now), closest: distance(closest) })
    : null;
}

function own(alarm) {
  const { kind, affected, total, group, devices = [], values = {} } = alarm;
  if (kind === 'collision' && affected === undefined && devices.length === 2) {
    return ofCollision(alarm);
  }
  const { details = [] } = alarm;
  if (kind === 'fault') {
    return details.length ? detailOf(details[0]) : null;
  }
  const key = affected === undefined ? kind : `${kind}-many`;
  if (!texts.sentences || !Object.hasOwn(texts.sentences, key)) {
    return null;
  }
  const sentence = texts.sentences[key];
  const names = devices.map(({ id }) => shortId(id));
  const named = devices.slice(0, MAX_NAMED).map(({ id }, index) => {
    const detail = details.find(({ device }) => device === id);
    const words = detail && detailOf(detail);
    return words ? `${names[index]} (${words})` : names[index];
  });
  const known = {
    affected, total, first: names[0], second: names[1],
    devices: `${named.join(', ')}${affected > MAX_NAMED ? ', …' : ''}`,
    group: group && groupOf(group),
    meters: values.meters === undefined ? undefined : distance(values.meters),
    late: values.late === undefined ? undefined : duration(values.late * 1000),
  };
  const isKnown = [...sentence.matchAll(/\{(\w+)/g)].every(([, name]) => known[name] !== undefined);
  return isKnown ? fill(sentence, known) : null;
}

function groupOf(id) {
  const [kind, prefix] = GROUPS.find((each) => id.startsWith(each[1])) ?? ['none', ''];
  const name = id.slice(prefix.length);
  return fill(texts.groups[kind], { name: kind === 'field' ? store.fields.get(name)?.name ?? name : name });
}
