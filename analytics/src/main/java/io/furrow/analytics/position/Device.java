package io.furrow.analytics.position;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/** A device of a topic, as a key. Not a record, because a record's own equality is slower by the cost of a whole lookup. */
@TypeInfo(DeviceSerializer.class)
public final class Device {
    private final String topic;
    private final String identity;

    public Device(String topic, String identity) {
        this.topic = topic;
        this.identity = identity;
    }

    String topic() {
        return topic;
    }

    String identity() {
        return identity;
    }

    @Override
    public boolean equals(Object other) {
        return this == other
                || other instanceof Device device && identity.equals(device.identity) && topic.equals(device.topic);
    }

    @Override
    public int hashCode() {
        return identity.hashCode();
    }

    @Override
    public String toString() {
        return topic + '|' + identity;
    }
}
