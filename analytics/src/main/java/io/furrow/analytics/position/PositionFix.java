package io.furrow.analytics.position;

import java.util.Comparator;

import org.apache.flink.api.common.typeinfo.TypeInfo;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.position.Position;

/**
 * The position of a device at an instant.
 *
 * @param reporter the device
 * @param latitude degrees, −90 to 90
 * @param longitude degrees, −180 to 180
 * @param speed meters per second as reported; NaN if unknown
 * @param heading degrees clockwise from north as reported, 0 to 360; NaN if unknown
 * @param time epoch milliseconds
 */
@TypeInfo(PositionFixSerializer.class)
public record PositionFix(
        DeviceInfo reporter, double latitude, double longitude, double speed, double heading, long time)
        implements HasEventTime {
    /** The order of the devices of a pair: by id, then by identity. */
    public static final Comparator<PositionFix> NAMING =
            Comparator.comparing(PositionFix::id).thenComparing(PositionFix::identity);

    /** By time; of two fixes of one device and instant the last in this order counts. */
    public static final Comparator<PositionFix> SEQUENCE = Comparator.comparingLong(PositionFix::time)
            .thenComparingDouble(PositionFix::latitude)
            .thenComparingDouble(PositionFix::longitude)
            .thenComparing(PositionFix::mission)
            .thenComparing(PositionFix::carrier)
            .thenComparing(PositionFix::type)
            .thenComparingDouble(PositionFix::speed)
            .thenComparingDouble(PositionFix::heading);

    /** Unknown texts are empty, never null. */
    public PositionFix(
            String topic,
            String identity,
            String id,
            String type,
            String mission,
            String carrier,
            double latitude,
            double longitude,
            double speed,
            double heading,
            long time) {
        this(
                DeviceInfo.of(new Device(topic, identity), id, type, mission, carrier),
                latitude,
                longitude,
                speed,
                heading,
                time);
    }

    /** The topic that reports the device; devices of two topics never meet. */
    public String topic() {
        return reporter.device().topic();
    }

    /** Tenant, service path, type and id, unique within the topic. */
    public String identity() {
        return reporter.device().identity();
    }

    public Position position() {
        return new Position(latitude, longitude);
    }

    public String id() {
        return reporter.id();
    }

    public String type() {
        return reporter.type();
    }

    public String mission() {
        return reporter.mission();
    }

    public String carrier() {
        return reporter.carrier();
    }

    /** Unique per device of a topic. A topic's name has no {@code |}. */
    public String key() {
        return topic() + '|' + identity();
    }

    /** The same without creating a text. */
    public Device device() {
        return reporter.device();
    }

    public boolean isOfSameDevice(PositionFix other) {
        return device().equals(other.device());
    }

    /** The tenant and service path from the identity. */
    public FiwareScope scope() {
        return FiwareScope.ofIdentity(identity());
    }

    /** The same device at the same place, with another carrier. */
    public PositionFix carriedBy(String other) {
        return new PositionFix(
                DeviceInfo.of(device(), id(), type(), mission(), other), latitude, longitude, speed, heading, time);
    }

    /** Tenant, service path and id: the name used by other devices and {@code service.devices}. */
    public String name() {
        return reporter.name();
    }

    /** Whether both are parts of one aggregate: they have the same id, one carries the other, or a third carries both. */
    public boolean sharesAggregateWith(PositionFix other) {
        return name().equals(other.name())
                || !carrier().isEmpty()
                        && (carrier().equals(other.name()) || carrier().equals(other.carrier()))
                || !other.carrier().isEmpty() && other.carrier().equals(name());
    }
}
