package io.furrow.control.alarm;

import java.time.Duration;
import java.util.List;

import io.furrow.model.control.AlarmKind;

/**
 * What raises an alarm.
 *
 * @param subject what it is about; of a kind and subject there is one alarm at a time
 * @param text a sentence for people
 * @param devices that it concerns, at most {@value #MAX_DEVICES}
 * @param holds how long it is so when nothing says that it still is; null until something says that it is over
 * @param group entity of the mission, domain or field that it belongs to, of which only so many have an alarm each; null for none
 * @param extent how many it stands for; null for one
 */
public record Cause(
        AlarmKind kind,
        String subject,
        String text,
        List<Device> devices,
        Duration holds,
        String group,
        Extent extent) {
    /** How many devices an alarm names. */
    public static final int MAX_DEVICES = 20;

    /**
     * @param id of its entity
     * @param type of its entity; null where that is not known
     */
    public record Device(String id, String type) {}

    /**
     * How many devices or pairs.
     *
     * @param total out of how many; null where that is not known
     */
    public record Extent(int affected, Integer total) {}

    public Cause {
        devices = List.copyOf(devices.subList(0, Math.min(devices.size(), MAX_DEVICES)));
    }

    /** A cause that stands for itself and belongs to no group. */
    public Cause(AlarmKind kind, String subject, String text, List<Device> devices, Duration holds) {
        this(kind, subject, text, devices, holds, null, null);
    }

    public Cause inGroup(String newGroup) {
        return new Cause(kind, subject, text, devices, holds, newGroup, extent);
    }

    /** A cause that stands for many, which lasts until something says that it is over. */
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
