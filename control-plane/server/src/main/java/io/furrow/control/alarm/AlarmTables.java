package io.furrow.control.alarm;

import io.furrow.control.manager.Table;

/**
 * The stores of the alarm manager.
 *
 * @param alarms by id; closed ones for a while
 * @param current ids of the alarms that are not closed, by kind and identity
 * @param mutes active mutes by kind and subject or identity; an empty subject stands for all of a kind
 * @param groups numbers of alarms and of causes without an alarm, by kind and group
 * @param overflows causes without an alarm, by kind and identity
 */
record AlarmTables(
        Table<Alarm> alarms,
        Table<String> current,
        Table<Mute> mutes,
        Table<AlarmLimit.Group> groups,
        Table<AlarmLimit.Overflow> overflows) {
    /**
     * Suppresses the delivery of alarms, including future ones.
     *
     * @param key kind and subject
     * @param until epoch ms
     * @param since epoch ms; null if it was stored before this member existed
     */
    record Mute(String key, long until, Long since) {
        /** As {@link Alarm#notAfter}. */
        Mute notAfter(long now) {
            return since == null || since <= now ? this : new Mute(key, until - since + now, now);
        }
    }
}
