package io.furrow.simulators.host;

import java.io.IOException;
import java.time.Duration;
import java.util.Collection;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;

import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.WantedDevice;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.fleet.FarmFleet;
import io.furrow.simulators.fleet.FleetAccess;
import io.furrow.simulators.fleet.FleetEvents;

/**
 * Runs the devices that are wanted on {@code service.devices} as a simulated fleet, and says on {@code service.devices.status} how
 * each is. It provisions none: the control plane does. All is on Kafka, so that a host that was killed goes on where it is
 * started again. There is to be one host at a time, because each runs all.
 */
public final class DeviceHost implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(DeviceHost.class);
    private static final Duration PATIENCE = Duration.ofSeconds(10);
    private static final Duration PAUSE = Duration.ofSeconds(1);

    private final WantedRecords records;
    private final StatusRecords statuses;
    private final FarmFleet fleet;
    private final StatusBoard board;
    private final Hosting hosting;
    private final KnownFields fields = new KnownFields();
    private final Queue<Runnable> told = new ConcurrentLinkedQueue<>();
    private final Thread thread = new Thread(this::run, "device-host");
    private volatile boolean caughtUp;
    private volatile boolean closed;

    private DeviceHost(HostSettings settings) {
        Properties kafka = settings.kafka();
        FleetSettings fiware = new FleetSettings(settings.contextBroker(), null, null, null, null, "", "/");
        FleetAccess access = new FleetAccess(fiware, settings.mqtt(), FleetAccess.Logins.of(settings.secret()));
        this.records = new WantedRecords(kafka, List.of(Topics.DEVICES, Topics.DEVICES_STATUS, Topics.FIELDS));
        this.statuses = new StatusRecords(kafka);
        this.board = new StatusBoard(statuses::say);
        this.fleet = FarmFleet.open(access, settings.secret()::apiKey, new Told());
        this.hosting = new Hosting(new Running(), board, settings.seed());
        thread.setDaemon(true);
    }

    /**
     * Starts; devices come up once the topics can be read and the MQTT broker lets them in. Kafka and the broker may be away at
     * that time.
     *
     * @throws IOException if the settings of Kafka are no such; the message says which
     */
    public static DeviceHost start(HostSettings settings) throws IOException {
        try {
            DeviceHost host = new DeviceHost(settings);
            host.thread.start();
            return host;
        } catch (KafkaException e) {
            throw new IOException("the host of devices cannot use Kafka with these settings: " + e.getMessage(), e);
        }
    }

    /** Whether all that was wanted at the start has been taken up; connections may still be on their way. */
    public boolean isCaughtUp() {
        return caughtUp;
    }

    /** Waits until it takes up nothing any more: because it was closed, or broke down, which is in the log. */
    public void await() throws InterruptedException {
        thread.join();
    }

    /** The fleet at work, for figures. */
    public FarmFleet fleet() {
        return fleet;
    }

    /** Stops all devices within seconds. Their statuses stay as they are: another host may go on. */
    @Override
    public void close() {
        closed = true;
        try {
            thread.join(PATIENCE.toMillis());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        fleet.close();
    }

    private void run() {
        try (records;
                statuses) {
            while (!closed) {
                try {
                    step();
                } catch (KafkaException e) {
                    LOG.warn("Kafka does not answer the host of devices, which goes on trying: {}", e.toString());
                    Thread.sleep(PAUSE.toMillis());
                }
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        } catch (RuntimeException e) {
            LOG.error("the host of devices stops taking up what is wanted; start it again", e);
        }
    }

    private void step() {
        Map<String, Map<String, byte[]>> fresh = records.next();
        if (!caughtUp) {
            statuses.remember(fresh.getOrDefault(Topics.DEVICES_STATUS, Map.of()));
        }
        if (fresh.containsKey(Topics.FIELDS)) {
            fields.take(fresh.get(Topics.FIELDS));
            hosting.know(fields.at(System.currentTimeMillis()));
        }
        if (fresh.containsKey(Topics.DEVICES)) {
            hosting.take(read(fresh.get(Topics.DEVICES)));
        }
        if (!caughtUp && records.isCaughtUp()) {
            hosting.forgetAllBut(statuses.keys());
            caughtUp = true;
        }
        for (Runnable next = told.poll(); next != null; next = told.poll()) {
            next.run();
        }
        statuses.repeatLost();
    }

    private static Map<String, WantedDevice> read(Map<String, byte[]> records) {
        Map<String, WantedDevice> devices = new LinkedHashMap<>();
        records.forEach((key, value) -> {
            try {
                devices.put(key, value == null ? null : WantedDevice.read(value));
            } catch (UnreadableException e) {
                LOG.warn("what is wanted of {} cannot be read and is passed over: {}", key, e.getMessage());
            }
        });
        return devices;
    }

    /** What the fleet tells, taken on the thread of the host. */
    private final class Told implements FleetEvents {
        @Override
        public void up(String device) {
            told.add(() -> board.up(device));
        }

        @Override
        public void failed(String device, int attempts, String reason) {
            told.add(() -> board.failed(device, attempts, reason));
        }
    }

    private final class Running implements Hosting.Fleet {
        @Override
        public void add(Collection<FarmFleet.Member> members) {
            fleet.add(members);
        }

        @Override
        public void remove(String device) {
            fleet.remove(device);
        }
    }
}
