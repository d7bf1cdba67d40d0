/** Lists domains, and the imported fields. */
import { absence } from '../../core/absence.js';
import { api } from '../../core/api.js';
import { csvButton } from '../../core/csv.js';
import { h, setText } from '../../core/dom.js';
import { askUndo, lastChange } from '../../core/field-changes.js';
import { icon } from '../../core/icons.js';
import { navigate } from '../../core/router.js';
import { store } from '../../core/store.js';
import { t } from '../../texts.js';
import { formRow, openDialog } from '../../core/dialog.js';
import { COLUMNS, fieldTable } from './fields.js';
import { importFields } from './import.js';
import { redraw } from '../../core/redraw.js';

export class Domains {
  constructor() {
    this.domains = h('div.stack');
    this.fields = h('div.stack');
    this.said = h('p.small', { role: 'status' });
    this.element = h('div.domain-columns', null,
      h('section.panel.stack', { 'aria-label': t('missions.domains') }, this.domains), h('section.panel.stack', { 'aria-label': t('missions.fields') }, this.fields, this.said));
    this.element.addEventListener('dragover', (event) => isFile(event) && event.preventDefault());
    this.element.addEventListener('drop', (event) => {
      if (isFile(event)) {
        event.preventDefault();
        store.may('operate') && importFields(event.dataTransfer);
      }
    });
    this.subscriptions = ['domains', 'missions', 'fields', 'me'].map((name) => store.on(name, () => this.draw()));
    this.draw();
  }

  draw() {
    const allowed = store.may('operate');
    const domains = [...store.domains.values()];
    redraw(this.domains,
      h('div.row', null, h('h2', null, t('missions.domains')), h('span.spacer'), allowed && h('button.button.small', { type: 'button', data: { act: 'new-domain' }, on: { click: newDomain } }, icon('plus', 16), t('missions.newDomain'))),
      absence('domains', domains.length, () => h('div.empty', null, h('h3', null, t('missions.noDomains')), h('p', null, t('missions.noDomainsHint')))),
      h('ul.stack', null, domains.map((each) => this.domain(each))));
    const fields = [...store.fields.values()].sort((a, b) => (a.name < b.name ? -1 : 1));
    redraw(this.fields,
      h('div.row', null, h('h2', null, t('missions.fields')), h('span.spacer'), fields.length > 0 && csvButton(t('missions.fields'), 'fields', COLUMNS, () => fields), allowed && h('button.button.small', { type: 'button', data: { act: 'import' }, on: { click: () => importFields() } }, icon('upload', 16), t('missions.importFields'))),
      absence('fields', fields.length, () => h('div.empty', null, h('h3', null, t('missions.noFields')), allowed && h('p', null, t('missions.noFieldsHint')))),
      fields.length > 0 && fieldTable(fields),
      allowed && lastChange() && h('div', null, h('button.button.small', { type: 'button', data: { act: 'undo-field' }, on: { click: () => this.undo() } }, icon('undo', 16), h('span.cut', null, t('draw.undo', { change: lastChange().words })))));
  }

  undo() {
    const say = (words, isBad) => { setText(this.said, words); this.said.classList.toggle('bad', isBad); };
    askUndo((words) => say(words, false), (error) => say(error.message, true));
  }

  domain(domain) {
    const missions = missionsOf(domain.domain);
    return h('li.card.row', null,
      h('div.cut', null, h('strong', null, domain.name ?? domain.domain), h('p.small.muted.cut', null, [domain.domain, domain.description].filter(Boolean).join(' · ')), h('p.small.muted', null, `${t('missions.countMissions', { count: missions.length })}, ${t('missions.countFields', { count: store.fieldsOf(domain.domain).length })}`)),
      h('span.spacer'),
      h('button.button.quiet.square', { type: 'button', 'aria-label': t('topics.showOnly', { name: domain.domain }), title: t('topics.showOnly', { name: domain.domain }), data: { act: `map ${domain.domain}` }, on: { click: () => { store.setScope({ domain: domain.domain }); navigate('map'); } } }, icon('map', 18)),
      store.may('administer') && h('button.button.quiet.square', { type: 'button', 'aria-label': t('missions.deleteDomain', { domain: domain.domain }), title: t('missions.deleteDomain', { domain: domain.domain }), data: { act: `delete ${domain.domain}` }, on: { click: () => deleteDomain(domain.domain) } }, icon('trash', 18)));
  }

  close() {
    this.subscriptions.forEach((unsubscribe) => unsubscribe());
  }
}

function isFile(event) {
  return event.dataTransfer.types.includes('Files');
}

function newDomain() {
  const id = h('input', { required: true, pattern: '[A-Za-z0-9_\\-]{1,64}', title: t('missions.nameHint'), autocomplete: 'off' });
  const name = h('input', { maxlength: 200, autocomplete: 'off' });
  const description = h('textarea', { maxlength: 1000 });
  openDialog({
    title: t('missions.newDomain'), submit: t('missions.create'),
    body: [formRow(t('missions.domainId'), id, t('missions.nameHint')), formRow(t('missions.domainName'), name), formRow(t('missions.description'), description)],
    work: () => api.post('/api/domains', { domain: id.value, ...(name.value ? { name: name.value } : {}), ...(description.value ? { description: description.value } : {}) }),
  });
  id.focus();
}

function missionsOf(domain) {
  return [...store.missions.values()].filter((each) => each.domain === domain);
}

function deleteDomain(domain) {
  const missions = missionsOf(domain);
  const fields = store.fieldsOf(domain);
  const running = missions.filter((each) => ['starting', 'running', 'stopping'].includes(each.status?.state));
  const force = h('input', { type: 'checkbox', required: true });
  openDialog({
    title: t('missions.deleteDomain', { domain }), submit: t('missions.delete'), danger: true,
    body: [
      h('p', null, missions.length + fields.length === 0
        ? t('missions.deleteDomainEmpty')
        : t('missions.deleteDomainText', { missions: t('missions.countMissions', { count: missions.length }), fields: t('missions.countFields', { count: fields.length }) })),
      running.length > 0 && h('label.check', null, force, t('missions.deleteDomainForce', { missions: running.map((each) => each.mission).join(', ') })),
    ],
    work: () => api.del(`/api/domains/${encodeURIComponent(domain)}${running.length ? '?force=true' : ''}`),
  });
}
