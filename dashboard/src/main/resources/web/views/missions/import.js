/** Imports fields from a file, and shows the result. */
import { api } from '../../core/api.js';
import { h, replace } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { formRow, openDialog } from '../../core/dialog.js';

const MAX_BYTES = 16 << 20;
const GEOPACKAGE = /\.gpkg$/i;

/** @param {DataTransfer=} dropped with the chosen file */
export function importFields(dropped) {
  const file = h('input', { type: 'file', required: true, accept: '.geojson,.json,.gpkg,application/geo+json,application/json' });
  const domain = h('select', null, h('option', { value: '' }, t('missions.asFeaturesSay')), [...store.domains.keys()].map((each) => h('option', { value: each }, each)));
  const preview = h('p.small.muted', { 'aria-live': 'polite' });
  const result = h('div.stack', { 'aria-live': 'polite' });
  let done = false;
  const { action, cancel } = openDialog({
    title: t('missions.importFields'), submit: t('missions.import'),
    body: [formRow(t('missions.file'), file, t('missions.fileHint')), formRow(t('missions.domain'), domain), preview, result],
    work: async () => {
      if (done) {
        return false;
      }
      const chosen = file.files[0];
      const type = GEOPACKAGE.test(chosen.name) ? 'application/geopackage+sqlite3' : 'application/geo+json';
      const query = domain.value ? `?domain=${encodeURIComponent(domain.value)}` : '';
      showResult(result, await api.post(`/api/fields${query}`, chosen, { headers: { 'Content-Type': type } }));
      done = true;
      action.replaceChildren(t('missions.close'));
      cancel.hidden = true; // nothing is left to cancel
      return true;
    },
  });
  file.addEventListener('change', async () => {
    done = false;
    replace(result);
    action.replaceChildren(t('missions.import'));
    cancel.hidden = false;
    const words = file.files[0] ? await previewOf(file.files[0]) : { text: '' };
    replace(preview, words.text);
    preview.classList.toggle('bad', Boolean(words.bad));
    action.disabled = Boolean(words.bad);
  });
  if (dropped) {
    file.files = dropped.files;
    file.dispatchEvent(new Event('change'));
  }
}

async function previewOf(file) {
  if (file.size > MAX_BYTES) {
    return { bad: true, text: t('missions.tooLarge', { size: Math.ceil(file.size / (1 << 20)) }) };
  }
  if (GEOPACKAGE.test(file.name)) {
    return { text: t('missions.previewGeoPackage') };
  }
  try {
    const content = JSON.parse(await file.text());
    const features = content.type === 'Feature' ? [content] : content.features;
    if (!Array.isArray(features)) {
      return { bad: true, text: t('missions.noGeoJson') };
    }
    const areas = features.filter((each) => /Polygon$/.test(each?.geometry?.type ?? '')).length;
    return { bad: areas === 0, text: t(areas < features.length ? 'missions.previewSome' : 'missions.previewFields', { count: features.length, areas, others: features.length - areas }) };
  } catch {
    return { bad: true, text: t('missions.noGeoJson') };
  }
}

function showResult(place, answer) {
  const rejected = answer.refused ?? [];
  const repaired = answer.fields.filter((each) => each.mended?.length);
  replace(place,
    h('p.row', { class: rejected.length ? 'warn' : 'good' }, icon(rejected.length ? 'warning' : 'check', 18), h('strong', null, t('missions.imported', { imported: answer.imported, unchanged: answer.unchanged }))),
    repaired.length > 0 && h('h3', null, t('missions.mendedFields', { count: repaired.length })),
    repaired.length > 0 && h('ul.findings', null, repaired.map((each) => h('li.finding.is-warning', null, icon('warning', 18),
      h('div', null, h('strong', null, each.name || each.id), h('p.small.muted', null, each.mended.join('; ')))))),
    rejected.length > 0 && h('h3', null, t('missions.refusedFields', { count: rejected.length })),
    rejected.length > 0 && h('ul.findings', null, rejected.map((each) => h('li.finding.is-problem', null, icon('close', 18),
      h('div', null, h('strong', null, t('missions.feature', { number: each.feature, id: each.id ?? '' })), h('p.small.muted', null, each.reason))))));
}
