package io.furrow.analytics.clock;

/**
 * A position that arrived too late to count although it is the newest of its device: its clock or its link is behind.
 *
 * @param topic the topic that reports the device
 * @param identity tenant, service path, type where it is known, and id
 * @param id the entity id
 * @param mission the mission it works for; empty if it names none
 * @param time of the position, epoch ms
 * @param reached how far event time had come, epoch ms; not before {@code time}
 * @param counted the time of the device's newest position that counted; {@link Long#MIN_VALUE} where none is known
 */
public record LaggingPosition(
        String topic, String identity, String id, String mission, long time, long reached, long counted) {
    /** One text per device of a topic. A topic's name has no {@code |}. */
    public String key() {
        return topic + '|' + identity;
    }
}
