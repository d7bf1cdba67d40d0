/** Creates a mission from a template or a list of devices, and checks the devices first. */
import { api } from '../../core/api.js';
import { h, replace } from '../../core/dom.js';
import { duration } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { checkPlan, farmNow } from './check.js';
import { formRow, openDialog } from '../../core/dialog.js';
import { findingsList, summaryOf } from './findings.js';

const NAME = '[A-Za-z0-9_\\-]{1,64}';
/** The choice of no template. */
const OWN = ' own';
const DEBOUNCE = 300;

const TYPES = ['Thermometer', 'WeatherStation', 'Camera', 'Robot'];
const PERIODS = [['PT1S', 1_000], ['PT10S', 10_000], ['PT1M', 60_000], ['PT15M', 900_000], ['PT1H', 3_600_000]];

/** A row for devices of one type; `group()` returns the element of the plan. */
function kindRow(changed) {
  const type = h('input', { required: true, list: 'device-types', pattern: '[A-Za-z][A-Za-z0-9]{0,63}', value: TYPES[0], autocomplete: 'off' });
  const count = h('input', { type: 'number', required: true, min: 1, max: 10_000, step: 1, value: 1, inputmode: 'numeric' });
  const period = h('select', null, PERIODS.map(([value, millis]) => h('option', { value, selected: value === 'PT1M' }, duration(millis))));
  const simulated = h('input', { type: 'checkbox' });
  const row = h('div.form-columns', { on: { input: changed } }, formRow(t('missions.type'), type), formRow(t('missions.count'), count), formRow(t('missions.period'), period),
    h('label.check', { title: t('missions.simulatedHint') }, simulated, t('missions.simulated')),
    h('button.button.quiet.square', { type: 'button', 'aria-label': t('missions.lessDevices'), on: { click: () => { row.remove(); changed(); } } }, icon('trash', 16)));
  row.group = () => ({ type: type.value, count: Number(count.value), period: period.value, simulated: simulated.checked });
  return row;
}

export async function createMission() {
  const name = h('input', { required: true, pattern: NAME, autocomplete: 'off', title: t('missions.nameHint') });
  const domain = h('select', { required: true }, [...store.domains.values()].sort((a, b) => (a.domain === 'canary') - (b.domain === 'canary')).map((each) => h('option', { value: each.domain }, each.name ? `${each.name} (${each.domain})` : each.domain)));
  const template = h('select', { required: true }, h('option', { value: '' }, t('missions.chooseTemplate')), h('option', { value: OWN }, t('missions.ownDevices')));
  const ids = h('textarea', { spellcheck: 'false', placeholder: 'urn:ngsi-ld:Thermometer:1' });
  const kinds = h('div.stack');
  const own = h('div.stack', { hidden: true }, h('datalist', { id: 'device-types' }, TYPES.map((type) => h('option', { value: type }))), kinds,
    h('button.button', { type: 'button', on: { click: () => kinds.append(kindRow(schedule)) } }, icon('plus', 16), t('missions.moreDevices2')),
    formRow(t('missions.ids'), ids, t('missions.ownHint')));
  const about = h('p.small.muted');
  const check = h('div.stack', { 'aria-live': 'polite' });
  const minutes = h('input', { type: 'number', min: 1, max: 525600, step: 1, inputmode: 'numeric' });
  const now = h('input', { type: 'checkbox', checked: true });
  let chosen = null;
  let created = null;

  const groups = () => (template.value === OWN ? [...[...kinds.children].map((row) => row.group()), ...ids.value.split(/\s+/).filter(Boolean)] : chosen?.devices ?? []);
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
      const length = minutes.value ? { duration: `PT${Number(minutes.value)}M` } : {};
      if (created !== name.value) { // starting alone would replace the devices of an existing mission
        await api.post('/api/missions', { mission: name.value, ...plan });
        created = name.value;
      }
      if (now.checked) {
        await api.post(`/api/missions/${encodeURIComponent(name.value)}/start`, { ...plan, ...length });
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
    const selected = template.value;
    own.hidden = selected !== OWN;
    replace(kinds, selected === OWN && kindRow(schedule));
    chosen = null;
    replace(about);
    replace(check, selected && selected !== OWN && h('div.skeleton', null, '…'));
    if (selected && selected !== OWN) {
      try {
        const found = await api.get(`/api/templates/${encodeURIComponent(selected)}`);
        if (template.value !== selected) {
          return;
        }
        chosen = found;
        replace(about, [chosen.description, chosen.devices.some((each) => each.simulated) && t('missions.simulatedTemplate')].filter(Boolean).join('. '));
      } catch (error) {
        replace(check, h('p.error-note', null, icon('warning'), error.message));
        return;
      }
    }
    draw();
  };
  let pending;
  const schedule = () => {
    clearTimeout(pending);
    pending = setTimeout(draw, DEBOUNCE);
  };
  template.addEventListener('change', choose);
  domain.addEventListener('change', draw);
  name.addEventListener('input', schedule);
  ids.addEventListener('input', schedule);
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
