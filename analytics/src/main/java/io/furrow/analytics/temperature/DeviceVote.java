package io.furrow.analytics.temperature;

import java.util.Comparator;

/**
 * The vote of a device in a field's window.
 *
 * @param domain of the field, as of the newest version among the readings
 * @param validFrom of that version, epoch ms
 * @param device entity id
 * @param value the median of its readings, in the attribute's unit
 * @param windowStart first instant of the window, epoch ms
 * @param windowEnd first instant after the window, epoch ms
 * @param type of the entity
 */
public record DeviceVote(
        String field,
        String domain,
        long validFrom,
        InputScope scope,
        String device,
        double value,
        long windowStart,
        long windowEnd,
        String type) {
    /** By id, then by type. */
    static final Comparator<DeviceVote> NAMING =
            Comparator.comparing(DeviceVote::device).thenComparing(DeviceVote::type);

    /** Type and id, unique within a field; the length makes it unambiguous. */
    String voter() {
        return type.length() + ":" + type + device;
    }

    /** The field, unique across topics and tenants: devices of two tenants are never averaged together. */
    String fieldIdentity() {
        return scope.identity(field);
    }
}
