/** Shows what real devices need to report: broker, login, topics and attribute names; as text, as a file, and as a QR code. */
import { api } from '../../core/api.js';
import { h, replace } from '../../core/dom.js';
import { shortId } from '../../core/format.js';
import { icon } from '../../core/icons.js';
import { t } from '../../texts.js';

const FACTS = ['host', 'port', 'tls', 'user', 'password', 'measures', 'commands', 'results'];

/** @param {string} mission whose devices are listed */
export async function showCredentials(mission) {
  const body = h('div.stack', { 'aria-live': 'polite' }, h('div.skeleton', null, '…'));
  const dialog = h('dialog.sheet', { 'aria-label': t('credentials.title', { mission }) });
  const urls = [];
  const close = () => dialog.close();
  replace(dialog, h('div.sheet-body', null,
    h('header', null, h('h2', null, t('credentials.title', { mission })), h('button.button.quiet.square', { type: 'button', 'aria-label': t('missions.close'), on: { click: close } }, icon('close'))),
    h('p.small.muted', null, t('credentials.hint')), body));
  dialog.addEventListener('close', () => {
    urls.forEach((url) => URL.revokeObjectURL(url));
    dialog.remove();
  });
  document.body.append(dialog);
  dialog.showModal();
  try {
    const path = `/api/missions/${encodeURIComponent(mission)}/credentials`;
    const devices = await api.get(path);
    const file = devices.length > 0 && await (await api.fetch(path, { headers: { Accept: 'text/csv' } })).blob();
    const url = file && URL.createObjectURL(file);
    urls.push(url);
    replace(body, devices.length === 0 ? h('p', null, t('credentials.none')) : [
      h('a.button', { href: url, download: `${mission}-credentials.csv`, data: { act: 'csv' } }, icon('download', 16), t('credentials.download', { count: devices.length })),
      devices.map((device) => entry(device, urls)),
    ]);
  } catch (error) {
    replace(body, h('p.error-note', { role: 'alert' }, icon('warning'), error.message));
  }
}

/** An entry is closed at first, so that passwords are not visible to bystanders. */
function entry(device, urls) {
  const content = h('div.stack');
  const details = h('details', { on: { toggle: () => details.open && content.childElementCount === 0 && fill(content, device, urls) } },
    h('summary', null, shortId(device.device)), content);
  return details;
}

async function fill(content, device, urls) {
  const code = h('img', { alt: t('credentials.code', { device: shortId(device.device) }), width: 220, height: 220 });
  replace(content,
    h('dl.attributes', null, FACTS.filter((name) => name in device).map((name) => fact(t(`credentials.facts.${name}`), String(device[name])))),
    h('p.small', null, t('credentials.sends', { names: device.attributes.map((each) => `${each.object_id} → ${each.name}${each.unit ? ` (${each.unit})` : ''}`).join(', ') })),
    h('pre.code.small.wrapped', null, device.example), code);
  try {
    const response = await api.fetch(`/api/devices/${encodeURIComponent(device.device)}/credentials/qr`);
    code.src = URL.createObjectURL(await response.blob());
    urls.push(code.src);
  } catch (error) {
    replace(code.parentElement ?? content, h('p.error-note', null, icon('warning'), error.message));
  }
}

function fact(name, value) {
  return h('div', null, h('dt', null, name), h('dd.code', null, value));
}
