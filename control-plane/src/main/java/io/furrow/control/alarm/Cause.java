package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;

import io.furrow.model.control.AlarmKind;

/**
 * What raises an alarm.
 *
 * @param subject what it is about; of a kind and subject there is one alarm at a time
 * @param text a sentence for people
 * @param devices that it concerns
 * @param holds how long it is so when nothing says that it still is; null until something says that it is over
 */
public record Cause(AlarmKind kind, String subject, String text, List<Device> devices, Duration holds) {
    /**
     * @param id of its entity
     * @param type of its entity; null where that is not known
     */
    public record Device(String id, String type) {}

    static String key(AlarmKind kind, String subject) {
        return kind.code() + "|" + subject;
    }

    String key() {
        return key(kind, subject);
    }

    Long until(long now) {
        return holds == null ? null : Long.valueOf(now + holds.toMillis());
    }
}
