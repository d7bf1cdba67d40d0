package io.furrow.control.alarm.action;

import io.furrow.control.alarm.AlarmState;
import io.furrow.model.ngsi.StateRecord;

/**
 * The last delivery of an alarm to the webhook: a record of {@code service.alarms.delivered} keyed by the alarm's id.
 *
 * @param sequence sequence number of the delivered alarm; 0 while no post of it was answered
 * @param state delivered state
 * @param time when, epoch ms
 * @param repeats how often that state was repeated because it lasted
 * @param refused whether the webhook rejected it permanently
 */
record DeliveryState(long sequence, AlarmState state, long time, int repeats, boolean refused) implements StateRecord {
    /** Before the first post of an alarm is answered. */
    static DeliveryState attempted(long time) {
        return new DeliveryState(0, AlarmState.OPEN, time, 0, false);
    }
}
