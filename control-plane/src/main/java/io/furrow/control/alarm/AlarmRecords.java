package io.furrow.control.alarm;

import io.furrow.control.manager.Records;

/**
 * All that the manager of alarms remembers.
 *
 * @param alarms by id; closed ones for a while
 * @param current ids of those that are not closed, by kind and subject
 * @param mutes until when, epoch ms, by kind and subject; no subject stands for all of a kind
 * @param groups how many alarms and causes without an alarm there are, by kind and group
 * @param counted causes without an alarm, by kind and subject
 */
record AlarmRecords(
        Records<Alarm> alarms,
        Records<String> current,
        Records<Mute> mutes,
        Records<AlarmLimit.Group> groups,
        Records<AlarmLimit.Counted> counted) {
    /**
     * That nobody is told of alarms, those to come too.
     *
     * @param key kind and subject
     * @param until epoch ms
     */
    record Mute(String key, long until) {}
}
