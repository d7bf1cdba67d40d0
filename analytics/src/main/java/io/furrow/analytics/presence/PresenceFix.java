package io.furrow.analytics.presence;

import java.util.Comparator;

import io.furrow.analytics.eventtime.Timed;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Position;

/**
 * Where a device was at an instant.
 *
 * @param topic the topic that tells of it; the device is another one in another topic
 * @param identity tenant, service path and id
 * @param id the entity id
 * @param mission the mission it works for; empty where it names none
 * @param latitude degrees, −90 to 90
 * @param longitude degrees, −180 to 180
 * @param time epoch milliseconds
 */
public record PresenceFix(
        String topic, String identity, String id, String mission, double latitude, double longitude, long time)
        implements Timed {
    /** By time; of two fixes of one device and instant the later in this order counts. */
    static final Comparator<PresenceFix> SEQUENCE = Comparator.comparingLong(PresenceFix::time)
            .thenComparingDouble(PresenceFix::latitude)
            .thenComparingDouble(PresenceFix::longitude)
            .thenComparing(PresenceFix::mission);

    /** One text per device of a topic. A topic's name has no {@code |}. */
    public String key() {
        return topic + '|' + identity;
    }

    Position position() {
        return new Position(latitude, longitude);
    }

    /** The tenant and service path that the identity begins with. */
    FiwareScope scope() {
        return FiwareScope.ofIdentity(identity);
    }
}
