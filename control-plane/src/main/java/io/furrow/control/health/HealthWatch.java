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
import io.furrow.control.manager.Inlet;
import io.furrow.control.manager.ObserveRecords;
import io.furrow.control.manager.ObserveRecords.Observer;
import io.furrow.control.manager.Outbox;
import io.furrow.control.manager.Outgoing;
import io.furrow.control.manager.Records;
import io.furrow.control.manager.StateJson;
import io.furrow.control.manager.StoreRecords;
import io.furrow.model.topic.Topics;

/** Reads {@code data.raw} and {@code service.devices} and keeps {@code service.devices.health} and the alarms of silent devices. */
public final class HealthWatch {
    private static final String WANTED = "wanted-devices";
    private static final String HEALTH = "device-health";

    private HealthWatch() {}

    /** The devices that shall run; every instance has all of them, for any processor. */
    public static WantedDevices wanted(ProcessorContext<?, ?> context) {
        return new WantedDevices(StoreRecords.of(context, WANTED, Function.identity(), Function.identity()));
    }

    /** Stores of its own that whoever uses {@link #typeOf} needs. */
    public static List<String> stores() {
        return List.of(HEALTH);
    }

    /** The type of the entity of a device: as it reports, else as it is wanted, else null. */
    public static Function<String, String> typeOf(ProcessorContext<?, ?> context) {
        Records<DeviceHealth> health = StoreRecords.of(context, HEALTH, DeviceHealth.class);
        WantedDevices wanted = wanted(context);
        return identity -> {
            DeviceHealth known = health.get(identity);
            return known != null && known.type() != null
                    ? known.type()
                    : wanted.of(identity).map(device -> device.type()).orElse(null);
        };
    }

    /** The stores of alarms are there already. */
    public static void add(StreamsBuilder builder, HealthOptions options) {
        builder.addGlobalStore(
                StoreRecords.builder(WANTED).withLoggingDisabled(),
                Topics.DEVICES,
                Consumed.with(Serdes.String(), Serdes.ByteArray()).withName("wanted-devices-in"),
                KeepWanted::new);
        builder.addStateStore(StoreRecords.builder(HEALTH));
        BiFunction<ProcessorContext<String, Outgoing>, Outbox, Observer> opening =
                (context, outbox) -> observer(new HealthDesk(
                        StoreRecords.of(context, HEALTH, DeviceHealth.class),
                        wanted(context),
                        options,
                        AlarmManager.desk(context, outbox),
                        outbox));

        KStream<String, byte[]> signs = builder.stream(
                        Topics.RAW,
                        Consumed.with(Serdes.String(), Serdes.ByteArray())
                                .withName("reports-in")
                                .withOffsetResetPolicy(AutoOffsetReset.latest()))
                .process(() -> new HearDevices(options), Named.as("hear-devices"));
        Outgoing.send(
                Inlet.inLine(signs, "device-signs")
                        .process(
                                () -> new ObserveRecords(opening),
                                Named.as("keep-device-health"),
                                Stream.concat(stores().stream(), AlarmManager.stores().stream())
                                        .toArray(String[]::new)),
                "device-health-out");
    }

    private static Observer observer(HealthDesk desk) {
        return new Observer() {
            @Override
            public void take(Record<String, byte[]> sign, long now) {
                desk.take(sign.key(), StateJson.read(sign.value(), Sign.class), now);
            }

            @Override
            public void passTime(long now) {
                desk.passTime(now);
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
