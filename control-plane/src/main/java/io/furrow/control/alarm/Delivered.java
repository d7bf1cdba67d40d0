package io.furrow.control.alarm;

import io.furrow.control.manager.StateJson;

/**
 * What of an alarm the webhook knows: a record of {@code service.alarms.delivered} under the alarm's id.
 *
 * @param sequence of the alarm as it was delivered
 * @param state in which it was delivered
 * @param time when, epoch ms
 * @param repeats how often that state was delivered again because it lasted
 * @param refused whether the webhook refused it for good
 */
record Delivered(long sequence, AlarmState state, long time, int repeats, boolean refused) {
    byte[] toBytes() {
        return StateJson.write(this);
    }
}
