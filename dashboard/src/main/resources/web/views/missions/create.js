/** A new mission from a template or a list of devices, checked before it starts. */
import { api } from '../../core/api.js';
import { h, replace } from '../../core/dom.js';
import { icon } from '../../core/icons.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { checkPlan, farmNow } from './check.js';
import { formRow, openDialog } from './dialog.js';
import { findingsList, summaryOf } from './findings.js';

const NAME = '[A-Za-z0-9_\\-]{1,64}';
/** Chosen instead of a template. */
const OWN = ' own';
const DEBOUNCE = 300;

export async function createMission() {
  const name = h('input', { required: true, pattern: NAME, autocomplete: 'off', title: t('missions.nameHint') });
  const domain = h('select', { required: true }, [...store.domains.values()].sort((a, b) => (a.domain === 'canary') - (b.domain === 'canary')).map((each) => h('option', { value: each.domain }, each.name ? `${each.name} (${each.domain})` : each.domain)));
  const template = h('select', { required: true }, h('option', { value: '' }, t('missions.chooseTemplate')), h('option', { value: OWN }, t('missions.ownDevices')));
  const ids = h('textarea', { spellcheck: 'false', placeholder: 'urn:ngsi-ld:Thermometer:1' });
  const own = h('div', { hidden: true }, formRow(t('missions.devices'), ids, t('missions.ownHint')));
  const about = h('p.small.muted');
  const check = h('div.stack', { 'aria-live': 'polite' });
  const minutes = h('input', { type: 'number', min: 1, max: 525600, step: 1, inputmode: 'numeric' });
  const now = h('input', { type: 'checkbox', checked: true });
  let chosen = null;
  let created = null;

  const groups = () => (template.value === OWN ? ids.value.split(/\s+/).filter(Boolean) : chosen?.devices ?? []);
  const { dialog, action } = openDialog({
    title: t('missions.new'),
    body: [
      h('div.form-columns', null, formRow(t('missions.name'), name, t('missions.nameHint')), formRow(t('missions.domain'), domain, domain.options.length === 0 ? t('missions.noDomainsHint') : null)),
      formRow(t('missions.template'), template), about, own, check,
      h('div.form-columns', null, formRow(t('missions.minutes'), minutes, t('missions.minutesHint')), h('label.check', null, now, t('missions.startNow'))),
    ],
    submit: t('missions.create'),
    work: async () => {
      const plan = { domain: domain.value, ...(template.value === OWN ? { devices: groups() } : { template: template.value }) };
      const lasts = minutes.value ? { duration: `PT${Number(minutes.value)}M` } : {};
      if (created !== name.value) { // a start alone would replace the devices of one that exists
        await api.post('/api/missions', { mission: name.value, ...plan });
        created = name.value;
      }
      if (now.checked) {
        await api.post(`/api/missions/${encodeURIComponent(name.value)}/start`, { ...plan, ...lasts });
      }
      dialog.dispatchEvent(new CustomEvent('created', { detail: name.value }));
    },
  });
  name.focus();

  const draw = () => {
    const checked = checkPlan(groups(), domain.value, farmNow(name.value));
    replace(check, checked.length > 0 && [h('h3', null, summaryOf(checked)), findingsList(checked)]);
  };
  const choose = async () => {
    const wanted = template.value;
    own.hidden = wanted !== OWN;
    ids.required = wanted === OWN;
    chosen = null;
    replace(about);
    replace(check, wanted && wanted !== OWN && h('div.skeleton', null, '…'));
    if (wanted && wanted !== OWN) {
      try {
        const found = await api.get(`/api/templates/${encodeURIComponent(wanted)}`);
        if (template.value !== wanted) {
          return;
        }
        chosen = found;
        replace(about, chosen.description ?? '');
      } catch (error) {
        replace(check, h('p.error-note', null, icon('warning'), error.message));
        return;
      }
    }
    draw();
  };
  let pending;
  const soon = () => {
    clearTimeout(pending);
    pending = setTimeout(draw, DEBOUNCE);
  };
  template.addEventListener('change', choose);
  domain.addEventListener('change', draw);
  name.addEventListener('input', soon);
  ids.addEventListener('input', soon);
  now.addEventListener('change', () => (minutes.disabled = !now.checked));
  dialog.addEventListener('close', () => clearTimeout(pending));
  action.disabled = domain.options.length === 0;

  try {
    const templates = await api.get('/api/templates');
    template.append(...templates.map((each) => h('option', { value: `${each.template}@${each.version}` }, t('missions.templateVersion', { template: each.template, version: each.version }))));
  } catch (error) {
    replace(about, t('missions.noTemplateList', { reason: error.message }));
  }
  return dialog;
}
