package io.furrow.control.health;

import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.stream.Stream;

import org.apache.kafka.streams.AutoOffsetReset;
import org.apache.kafka.streams.kstream.KStream;
import org.apache.kafka.streams.kstream.Named;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.alarm.AlarmManager;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Observer;
import io.furrow.control.manager.StoreTable;
import io.furrow.control.manager.Table;
import io.furrow.control.manager.UnitOfWork;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Reads {@code data.raw}, {@code service.devices} and {@code service.devices.connection} and maintains {@code service.devices.health} and the alarms of
 * silent devices.
 */
public final class HealthWatch {
    private static final Logger LOG = LoggerFactory.getLogger(HealthWatch.class);
    private static final String DESIRED = "desired-devices";
    private static final String HEALTH = "device-health";
    private static final String CONNECTIONS = "device-connections";

    private HealthWatch() {}

    /** Returns the desired devices from a global store, which every instance and any processor can read. */
    static MonitoredDevices desired(ProcessorContext<?, ?> context) {
        return new MonitoredDevices(StoreTable.readOnly(context, DESIRED));
    }

    private static MonitoredDevices desired(UnitOfWork unitOfWork) {
        return new MonitoredDevices(unitOfWork.table(DESIRED));
    }

    /** Names of the stores that users of {@link #typeOf} need. */
    public static List<String> stores() {
        return List.of(HEALTH);
    }

    /** Returns a lookup of a device's entity type: the reported type, else the desired type, else null. */
    public static Function<String, String> typeOf(UnitOfWork unitOfWork) {
        Table<DeviceHealth> health = unitOfWork.table(HEALTH, DeviceHealth.class);
        MonitoredDevices desired = desired(unitOfWork);
        return identity -> {
            DeviceHealth existing = health.get(identity);
            return existing != null && existing.device().type() != null
                    ? existing.device().type()
                    : desired.of(identity).map(device -> device.type()).orElse(null);
        };
    }

    /** Adds the processors. The stores of alarms must exist already. */
    public static void add(ManagerTopology topology, HealthOptions options) {
        topology.addGlobalStore(DESIRED, Topics.DEVICES);
        topology.addGlobalStore(CONNECTIONS, Topics.DEVICES_CONNECTION);
        topology.addStores(stores());
        KStream<String, byte[]> signs = topology.stream(Topics.RAW, "reports-in", AutoOffsetReset.latest())
                .process(() -> new HeartbeatProcessor(options), Named.as("hear-devices"));
        ManagerTopology.observe(
                ManagerTopology.toSinglePartition(signs, "device-heartbeats"),
                new ManagerTopology.Nodes("keep-device-health", "device-health-out"),
                true,
                unitOfWork -> observer(new DeviceHealthTracker(
                        unitOfWork.table(HEALTH, DeviceHealth.class),
                        desired(unitOfWork),
                        options,
                        new SilenceAlarmReconciler(options, AlarmManager.handler(unitOfWork), connections(unitOfWork)),
                        unitOfWork)),
                Stream.concat(stores().stream(), AlarmManager.stores().stream()).toList());
    }

    private static Function<String, Optional<DeviceConnection>> connections(UnitOfWork unitOfWork) {
        Table<byte[]> records = unitOfWork.table(CONNECTIONS);
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
