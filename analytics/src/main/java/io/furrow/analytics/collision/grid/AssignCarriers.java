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
 * Assigns to each position what carries its device: what the entity named, else what {@code service.devices} says as
 * of the position's time. The ground carries a stationary device. Key: the device, which has no state here; its positions are on their way to the stage that
 * has.
 *
 * <p><b>State</b>: every device's versions, the same at each subtask.
 *
 * <p><b>Cleared</b>: versions, 30 days after they ended; where a replay is read, never.
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
    /** Longer than the job is down: all changes are read before the backlog is. As ingest has it. */
    private static final Duration KEPT = Duration.ofDays(30);

    /** Carries the devices that do not move, so that they are parts of one aggregate; no identity is without a scope. */
    private static final String GROUND = "ground";

    private static final Duration FOR_EVER = Duration.ofMillis(Epochs.SPAN);

    private final DeviceLookup devices;

    AssignCarriers(TopicSnapshot devicesAtStart) {
        this(devicesAtStart, false);
    }

    /** @param isReplay whether positions come of any time before now, again and again */
    public AssignCarriers(TopicSnapshot devicesAtStart, boolean isReplay) {
        devices = new DeviceLookup(devicesAtStart, isReplay ? FOR_EVER : KEPT);
    }

    /** Reads what is known of devices before the first position comes, here and after each restart. */
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
