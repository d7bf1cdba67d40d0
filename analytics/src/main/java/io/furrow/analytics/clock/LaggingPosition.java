package io.furrow.analytics.clock;

/**
 * A late position that is nevertheless the newest of its device: the device's clock or link is behind.
 *
 * @param topic the topic that reports the device
 * @param identity tenant, service path, type if known, and id
 * @param id the entity id
 * @param mission of the device; empty if it names none
 * @param time of the position, epoch ms
 * @param reached event time at its arrival, epoch ms; not before {@code time}
 * @param counted time of the device's newest accepted position; {@link Long#MIN_VALUE} if there is none
 */
public record LaggingPosition(
        String topic, String identity, String id, String mission, long time, long reached, long counted) {
    /** Unique per device of a topic. A topic's name has no {@code |}. */
    public String key() {
        return topic + '|' + identity;
    }
}
