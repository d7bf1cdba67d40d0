package io.furrow.control.health;

import java.util.List;
import java.util.function.BiFunction;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.StreamsBuilder;
import org.apache.kafka.streams.kstream.Consumed;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.state.KeyValueStore;

import io.furrow.control.alarm.AlarmManager;
import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.ManagerInput;
import io.furrow.control.manager.ObserverProcessor;
import io.furrow.control.manager.ObserverProcessor.Observer;
import io.furrow.control.manager.OutputRecord;
import io.furrow.control.manager.StateJson;
import io.furrow.control.manager.record.Records;
import io.furrow.control.manager.record.StoredRecords;
import io.furrow.model.topic.Topics;

/**
 * Reads {@code data.raw} and {@code service.devices} and maintains {@code service.devices.health} and the alarms of
 * silent devices.
 */
public final class HealthWatch {
    private static final String WANTED = "wanted-devices";
    private static final String HEALTH = "device-health";

    private HealthWatch() {}

    /** Returns the desired devices from a global store, which every instance and any processor can read. */
    public static WantedDevices wanted(ProcessorContext<?, ?> context) {
        return new WantedDevices(StoredRecords.of(context, WANTED, Function.identity(), Function.identity()));
    }

    /** Names of the stores that users of {@link #typeOf} need. */
    public static List<String> stores() {
        return List.of(HEALTH);
    }

    /** Returns a lookup of a device's entity type: the reported type, else the desired type, else null. */
    public static Function<String, String> typeOf(ProcessorContext<?, ?> context) {
        Records<DeviceHealth> health = StoredRecords.of(context, HEALTH, DeviceHealth.class);
        WantedDevices wanted = wanted(context);
        return identity -> {
            DeviceHealth known = health.get(identity);
            return known != null && known.type() != null
                    ? known.type()
                    : wanted.of(identity).map(device -> device.type()).orElse(null);
        };
    }

    /** Adds the processors. The stores of alarms must exist already. */
    public static void add(StreamsBuilder builder, HealthOptions options) {
        builder.addGlobalStore(
                StoredRecords.builder(WANTED).withLoggingDisabled(),
                Topics.DEVICES,
                Consumed.with(Serdes.String(), Serdes.ByteArray()).withName("wanted-devices-in"),
                KeepWanted::new);
        builder.addStateStore(StoredRecords.builder(HEALTH));
        BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening =
                (context, outbox) -> observer(new DeviceHealthTracker(
                        StoredRecords.of(context, HEALTH, DeviceHealth.class),
                        wanted(context),
                        options,
                        AlarmManager.handler(context, outbox),
                        outbox));

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

    private static Observer observer(DeviceHealthTracker tracker) {
        return new Observer() {
            @Override
            public void take(Record<String, byte[]> sign, long now) {
                tracker.take(sign.key(), StateJson.read(sign.value(), Heartbeat.class), now);
            }

            @Override
            public void passTime(long now) {
                tracker.passTime(now);
            }
        };
    }

    private static final class KeepWanted extends ContextualProcessor<String, byte[], Void, Void> {
        private KeyValueStore<String, byte[]> wanted;

        @Override
        public void init(ProcessorContext<Void, Void> context) {
            wanted = context.getStateStore(WANTED);
        }

        @Override
        public void process(Record<String, byte[]> record) {
            if (record.key() != null) {
                wanted.put(record.key(), record.value());
            }
        }
    }
}
