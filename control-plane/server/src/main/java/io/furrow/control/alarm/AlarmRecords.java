package io.furrow.control.alarm;

import io.furrow.control.manager.Records;

/**
 * The stores of the alarm manager.
 *
 * @param alarms by id; closed ones for a while
 * @param current ids of the alarms that are not closed, by kind and identity
 * @param mutes active mutes by kind and subject or identity; an empty subject stands for all of a kind
 * @param groups numbers of alarms and of causes without an alarm, by kind and group
 * @param counted causes without an alarm, by kind and identity
 */
record AlarmRecords(
        Records<Alarm> alarms,
        Records<String> current,
        Records<Mute> mutes,
        Records<AlarmLimit.Group> groups,
        Records<AlarmLimit.Counted> counted) {
    /**
     * Suppresses the delivery of alarms, including future ones.
     *
     * @param key kind and subject
     * @param until epoch ms
     */
    record Mute(String key, long until) {}
}
