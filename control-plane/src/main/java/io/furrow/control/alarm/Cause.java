package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;

import io.furrow.model.control.AlarmKind;

/**
 * The cause of an alarm.
 *
 * @param subject the affected entity or pair; there is at most one open alarm per kind and subject
 * @param text human-readable sentence
 * @param devices devices concerned, at most {@value #MAX_DEVICES}
 * @param holds validity unless the cause is repeated; null if it lasts until ended explicitly
 * @param group entity of the mission, domain or field, which limits the number of individual alarms; null if none
 * @param extent how many devices or pairs a group cause stands for; null for an individual cause
 */
public record Cause(
        AlarmKind kind,
        String subject,
        String text,
        List<Device> devices,
        Duration holds,
        String group,
        Extent extent) {
    /** Maximum number of devices that an alarm names. */
    public static final int MAX_DEVICES = 20;

    /**
     * @param id of its entity
     * @param type of its entity; null if unknown
     */
    public record Device(String id, String type) {}

    /**
     * Number of affected devices or pairs.
     *
     * @param total out of how many; null if unknown
     */
    public record Extent(int affected, Integer total) {}

    public Cause {
        devices = List.copyOf(devices.subList(0, Math.min(devices.size(), MAX_DEVICES)));
    }

    /** Creates an individual cause without a group. */
    public Cause(AlarmKind kind, String subject, String text, List<Device> devices, Duration holds) {
        this(kind, subject, text, devices, holds, null, null);
    }

    public Cause inGroup(String newGroup) {
        return new Cause(kind, subject, text, devices, holds, newGroup, extent);
    }

    /** Creates a group cause that lasts until it is ended explicitly. */
    public static Cause ofMany(AlarmKind kind, String group, String text, List<Device> devices, Extent extent) {
        return new Cause(kind, group, text, devices, null, group, extent);
    }

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
