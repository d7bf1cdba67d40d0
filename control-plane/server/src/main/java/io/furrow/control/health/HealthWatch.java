package io.furrow.control.health;

import java.util.List;
import java.util.Optional;
import java.util.function.BiFunction;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.alarm.AlarmManager;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.GlobalStoreProcessor;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ObserverProcessor;
import io.furrow.control.manager.ObserverProcessor.Observer;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.StateJson;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.manager.Table;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Reads {@code data.raw}, {@code service.devices} and {@code service.devices.connection} and maintains {@code service.devices.health} and the alarms of
 * silent devices.
 */
public final class HealthWatch {
    private static final Logger LOG = LoggerFactory.getLogger(HealthWatch.class);
    private static final String WANTED = "wanted-devices";
    private static final String HEALTH = "device-health";
    private static final String CONNECTIONS = "device-connections";

    private HealthWatch() {}

    /** Returns the desired devices from a global store, which every instance and any processor can read. */
    public static MonitoredDevices desired(ProcessorContext<?, ?> context) {
        return new MonitoredDevices(StoreTable.of(context, WANTED, Function.identity(), Function.identity()));
    }

    /** Names of the stores that users of {@link #typeOf} need. */
    public static List<String> stores() {
        return List.of(HEALTH);
    }

    /** Returns a lookup of a device's entity type: the reported type, else the desired type, else null. */
    public static Function<String, String> typeOf(ProcessorContext<?, ?> context) {
        Table<DeviceHealth> health = StoreTable.of(context, HEALTH, DeviceHealth.class);
        MonitoredDevices desired = desired(context);
        return identity -> {
            DeviceHealth existing = health.get(identity);
            return existing != null && existing.type() != null
                    ? existing.type()
                    : desired.of(identity).map(device -> device.type()).orElse(null);
        };
    }

    /** Adds the processors. The stores of alarms must exist already. */
    public static void add(StreamsBuilder builder, HealthOptions options) {
        builder.addGlobalStore(
                StoreTable.builder(WANTED).withLoggingDisabled(),
                Topics.DEVICES,
                Consumed.with(Serdes.String(), Serdes.ByteArray()).withName("wanted-devices-in"),
                () -> new GlobalStoreProcessor(WANTED));
        builder.addGlobalStore(
                StoreTable.builder(CONNECTIONS).withLoggingDisabled(),
                Topics.DEVICES_CONNECTION,
                Consumed.with(Serdes.String(), Serdes.ByteArray()).withName("device-connections-in"),
                () -> new GlobalStoreProcessor(CONNECTIONS));
        builder.addStateStore(StoreTable.builder(HEALTH));
        BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening =
                (context, publisher) -> observer(new DeviceHealthTracker(
                        StoreTable.of(context, HEALTH, DeviceHealth.class),
                        desired(context),
                        options,
                        new SilenceAlarmReconciler(
                                options, AlarmManager.handler(context, publisher), connections(context)),
                        publisher));

        KStream<String, byte[]> signs = builder.stream(
                        Topics.RAW,
                        Consumed.with(Serdes.String(), Serdes.ByteArray())
                                .withName("reports-in")
                                .withOffsetResetPolicy(AutoOffsetReset.latest()))
                .process(() -> new HeartbeatProcessor(options), Named.as("hear-devices"));
        OutputRecord.send(
                ManagerInput.toSinglePartition(signs, "device-signs")
                        .process(
                                () -> new ObserverProcessor(opening),
                                Named.as("keep-device-health"),
                                Stream.concat(stores().stream(), AlarmManager.stores().stream())
                                        .toArray(String[]::new)),
                "device-health-out");
    }

    private static Function<String, Optional<DeviceConnection>> connections(ProcessorContext<?, ?> context) {
        Table<byte[]> records = StoreTable.of(context, CONNECTIONS, Function.identity(), Function.identity());
        return key -> {
            try {
                byte[] value = records.get(key);
                return value == null ? Optional.empty() : Optional.of(DeviceConnection.read(value));
            } catch (UnreadableException e) {
                LOG.debug("an unreadable record of service.devices.connection is skipped", e);
                return Optional.empty();
            }
        };
    }

    private static Observer observer(DeviceHealthTracker tracker) {
        return new Observer() {
            @Override
            public void take(Record<String, byte[]> heartbeat, long now) {
                tracker.take(heartbeat.key(), StateJson.read(heartbeat.value(), Heartbeat.class), now);
            }

            @Override
            public void passTime(long now) {
                tracker.passTime(now);
            }
        };
    }
}
