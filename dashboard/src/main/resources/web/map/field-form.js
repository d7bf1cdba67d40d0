/** The form with the attributes and the corners of a field or zone. */
import { formRow, openDialog } from '../core/dialog.js';
import { h } from '../core/dom.js';
import { store } from '../core/store.js';
import { t } from '../texts.js';
import { cornersText, faultOf, longestDirection, readCorners } from './outline.js';

const ZONE = 'exclusion';

/**
 * Opens the form.
 *
 * @param {{title: string, properties: Object, geometry: Object|null}} options `geometry` null: the corners are typed
 * @param {function({geometry: Object, properties: Object}): Promise} work writes the field
 */
export function fieldForm({ title, properties, geometry }, work) {
  const name = h('input', { required: true, maxlength: 200, autocomplete: 'off', value: properties.name ?? '' });
  const domains = [...new Set([...store.domains.keys(), ...[properties.Domain].filter(Boolean)])].sort();
  const domain = h('select', null, h('option', { value: '' }, t('draw.noDomain')), domains.map((each) => h('option', { value: each, selected: each === properties.Domain }, each)));
  const kind = h('select', { on: { change: () => showKind() } }, [['', 'missions.field'], [ZONE, 'missions.zone']].map(([value, words]) =>
    h('option', { value, selected: value === (properties.kind ?? '') }, t(words))));
  const crop = h('input', { list: 'crops', maxlength: 100, autocomplete: 'off', value: properties.crop ?? '' });
  const crops = [...new Set([...store.fields.values()].map((each) => each.properties.crop).filter((each) => typeof each === 'string'))].sort();
  const direction = h('input', { type: 'number', min: 0, max: 359, step: 'any', inputmode: 'decimal', value: properties.rowDirection ?? '' });
  const corners = h('textarea.code', { rows: 6, spellcheck: 'false', placeholder: '40.3123456, -3.4823456', value: cornersText(geometry) });
  const typed = corners.value;
  const shape = () => (corners.value === typed ? { geometry } : readCorners(corners.value, geometry));
  const alongSide = h('button.button.small', { type: 'button', on: { click: () => { const read = shape(); read.geometry && (direction.value = longestDirection(read.geometry)); } } }, t('draw.alongSide'));
  const ofField = h('div.form-columns', null,
    h('div', null, h('datalist', { id: 'crops' }, crops.map((each) => h('option', { value: each }))), formRow(t('draw.crop'), crop)),
    h('div.stack', null, formRow(t('draw.rowDirection'), direction, t('draw.rowDirectionHint')), alongSide));
  const ofZone = h('p.small.muted', null, t('draw.zoneHint'));
  const showKind = () => {
    ofField.hidden = kind.value === ZONE;
    ofZone.hidden = kind.value !== ZONE;
  };
  showKind();
  openDialog({
    title, submit: t('draw.save'),
    body: [
      formRow(t('missions.name'), name),
      h('div.form-columns', null, formRow(t('missions.domain'), domain), formRow(t('missions.fieldColumns.kind'), kind)),
      ofField, ofZone,
      h('details', { open: geometry === null }, h('summary', null, t('draw.corners')), formRow(t('draw.cornersLabel'), corners, t('draw.cornersHint'))),
    ],
    work: () => {
      const read = shape();
      const fault = read.geometry ? faultOf(read.geometry) : null;
      if (read.line || read.rings || fault) {
        throw new Error(read.line ? t('draw.noCorner', { line: read.line }) : read.rings ? t('draw.rings', { count: read.rings }) : faultWords(fault));
      }
      const isZone = kind.value === ZONE;
      return work({ geometry: read.geometry, properties: without({
        ...properties, name: name.value.trim(), Domain: domain.value, kind: kind.value || (properties.kind === ZONE ? '' : properties.kind),
        crop: isZone ? '' : crop.value.trim(), rowDirection: isZone || direction.value === '' ? '' : Number(direction.value),
      }) });
    },
  });
  name.focus();
}

/** A sentence about a fault of an outline. */
export function faultWords({ text, at }) {
  return t(`draw.faults.${text}`, at ? { place: `${at[1].toFixed(5)}, ${at[0].toFixed(5)}` } : {});
}

/** The properties that have a value. */
function without(properties) {
  return Object.fromEntries(Object.entries(properties).filter(([, value]) => value !== '' && value !== undefined));
}
