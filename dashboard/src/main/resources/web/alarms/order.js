/** Selects and sorts alarms. */

const SEVERITY = { __proto__: null, critical: 0, major: 1, minor: 2, warning: 3 };

/**
 * Divides alarms and sorts them by severity, then the newest first.
 *
 * @param {Iterable<Object>} alarms records of `service.alarms`
 * @param {number} now epoch ms
 * @returns {{open: Object[], quiet: Object[]}} quiet alarms are acknowledged, muted or inhibited by another one
 */
export function arrange(alarms, now) {
  const open = [];
  const quiet = [];
  for (const alarm of alarms) {
    if (alarm.state !== 'closed') {
      (isQuiet(alarm, now) ? quiet : open).push(alarm);
    }
  }
  const order = (a, b) => (SEVERITY[a.severity] ?? 4) - (SEVERITY[b.severity] ?? 4) || b.raised - a.raised || (a.alarm < b.alarm ? -1 : 1);
  return { open: open.sort(order), quiet: quiet.sort(order) };
}

export function isMuted(alarm, now) {
  return alarm.mutedUntil > now;
}

function isQuiet(alarm, now) {
  return alarm.state === 'acknowledged' || isMuted(alarm, now) || Boolean(alarm.inhibitedBy);
}
