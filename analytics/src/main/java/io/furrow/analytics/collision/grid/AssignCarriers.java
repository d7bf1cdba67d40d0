package io.furrow.analytics.collision.grid;

import java.io.IOException;
import java.time.Duration;
import java.util.Optional;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.functions.co.KeyedBroadcastProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.device.DeviceChange;
import io.furrow.flink.device.DeviceLookup;
import io.furrow.flink.device.DeviceVersions;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.Epochs;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;

/**
 * Assigns to each position the carrier of its device: the one that the entity names, else the one that {@code service.devices} states as of
 * the position's time. A stationary device is carried by the ground. Key: the device, so that its positions are already partitioned for the
 * next stage; no keyed state.
 *
 * <p><b>State</b>: the versions of all devices, the same in each subtask.
 *
 * <p><b>Cleared</b>: versions, 30 days after their end; never while a replay is read.
 *
 * <p><b>Late</b>: a position gets its carrier as of its own time.
 *
 * <p><b>Emits</b>: every position once.
 */
public final class AssignCarriers
        extends KeyedBroadcastProcessFunction<Device, PositionFix, DeviceChange, PositionFix> {
    /** The devices, by identity. */
    public static final MapStateDescriptor<String, DeviceVersions> DEVICES =
            new MapStateDescriptor<>("devices", Types.STRING, TypeInformation.of(DeviceVersions.class));

    private static final long serialVersionUID = 1L;
    /** Longer than a job is down, because all changes are read before the backlog. The same as in ingest. */
    private static final Duration KEPT = Duration.ofDays(30);

    /** The carrier of stationary devices, so that they are parts of one aggregate; no identity lacks a scope. */
    private static final String GROUND = "ground";

    private static final Duration FOR_EVER = Duration.ofMillis(Epochs.SPAN);

    private final DeviceLookup devices;

    AssignCarriers(TopicSnapshot devicesAtStart) {
        this(devicesAtStart, false);
    }

    /** @param isReplay whether positions may have any past time, repeatedly */
    public AssignCarriers(TopicSnapshot devicesAtStart, boolean isReplay) {
        devices = new DeviceLookup(devicesAtStart, isReplay ? FOR_EVER : KEPT);
    }

    /** Reads the stored versions of devices before the first position, also after each restart. */
    @Override
    public void open(OpenContext context) throws IOException {
        devices.open();
    }

    @Override
    public void processElement(PositionFix fix, ReadOnlyContext context, Collector<PositionFix> out) throws Exception {
        if (!fix.carrier().isEmpty()) {
            out.collect(fix);
            return;
        }
        Optional<String> carrier = devices.at(fix.name(), fix.time(), context.getBroadcastState(DEVICES))
                .map(device -> carrier(device, fix.scope()));
        out.collect(carrier.isEmpty() ? fix : fix.carriedBy(carrier.get()));
    }

    @Override
    public void processBroadcastElement(DeviceChange change, Context context, Collector<PositionFix> out)
            throws Exception {
        devices.note(change, context.getBroadcastState(DEVICES));
    }

    private static String carrier(DeviceVersion device, FiwareScope scope) {
        if (device.carriedBy() != null && !device.carriedBy().isEmpty()) {
            return scope.identity(device.carriedBy());
        }
        return device.stationary() ? GROUND : null;
    }
}
