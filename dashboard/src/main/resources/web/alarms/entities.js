/** The entities that an alarm concerns. */
import { isIn, scope } from '../core/identities.js';
import { store } from '../core/store.js';

/** The entities of an alarm's devices. Alarms of an older control plane name neither tenant nor path. */
export function entitiesOf(alarm) {
  return (alarm.devices ?? []).map(({ id, type, service, servicePath }) => {
    const of = scope(service, servicePath);
    const entity = store.entities.get(store.identities.keyOf(id, of, type ?? ''));
    return alarm.identity ? entity && isIn(entity.identity, of) && entity : entity ?? store.entities.get(store.identities.keyOfType(id, type));
  }).filter(Boolean);
}
