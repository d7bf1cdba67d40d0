package io.furrow.simulators.host;

import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.function.BooleanSupplier;

import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.fleet.FarmFleet;
import io.furrow.simulators.fleet.FleetAccess;
import io.furrow.simulators.fleet.FleetEvents;

/** Hosts devices, from reading all desired ones until close, or until an exception after which a new loop starts. */
final class HostLoop implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(HostLoop.class);
    private static final Duration RETRY_BACKOFF = Duration.ofSeconds(1);

    private final Clock clock = Clock.systemUTC();
    private final DesiredStateConsumer records;
    private final StatusRecords statuses;
    private final FarmFleet fleet;
    private final StatusPublisher statusPublisher;
    private final FleetReconciler reconciler;
    private final FarmSecretCheck secret;
    private final FieldCache fields = new FieldCache();
    private final Queue<Runnable> events = new ConcurrentLinkedQueue<>();
    private volatile boolean caughtUp;
    private volatile Instant lastPoll;

    HostLoop(HostSettings settings) {
        Properties kafka = settings.kafka();
        FleetSettings fiware = new FleetSettings(settings.contextBroker(), null, null, null, null, "", "/")
                .withToken(settings.token());
        this.secret = new FarmSecretCheck(settings.secret());
        FleetAccess access = new FleetAccess(fiware, settings.mqtt(), FleetAccess.Logins.of(secret));
        this.records = new DesiredStateConsumer(
                kafka,
                List.of(Topics.DEVICES, Topics.MISSION_DEVICES, Topics.DEVICES_STATUS, Topics.FIELDS, Topics.SECRETS));
        this.statuses = new StatusRecords(kafka);
        this.statusPublisher = new StatusPublisher(statuses::publish);
        this.fleet = FarmFleet.open(access, mission -> secret.get().apiKey(mission), new EventQueue());
        this.reconciler = new FleetReconciler(fleet::add, fleet::remove, statusPublisher, settings.seed());
    }

    boolean isCaughtUp() {
        return caughtUp;
    }

    /** Time of the last successful poll; null before the first. */
    Instant lastPoll() {
        return lastPoll;
    }

    FarmFleet fleet() {
        return fleet;
    }

    /** Hosts until closing; retries while Kafka is unavailable. */
    void run(BooleanSupplier closing) throws InterruptedException, FarmSecretCheck.AnotherSecretException {
        while (!closing.getAsBoolean()) {
            try {
                step();
                lastPoll = clock.instant();
            } catch (KafkaException e) {
                LOG.warn("Kafka does not answer the host of devices, which retries: {}", e.toString());
                Thread.sleep(RETRY_BACKOFF.toMillis());
            }
        }
    }

    /** Stops all devices within seconds. Their statuses stay as they are: another host may continue. */
    @Override
    public void close() {
        fleet.close();
        records.close();
        statuses.close();
    }

    private void step() throws FarmSecretCheck.AnotherSecretException {
        Map<String, Map<String, byte[]>> fresh = records.next();
        secret.take(fresh.getOrDefault(Topics.SECRETS, Map.of()));
        if (secret.isChanged()) {
            fleet.renew();
        }
        if (!caughtUp) {
            statuses.remember(fresh.getOrDefault(Topics.DEVICES_STATUS, Map.of()));
        }
        if (fresh.containsKey(Topics.FIELDS)) {
            fields.take(fresh.get(Topics.FIELDS));
            reconciler.update(fields.at(System.currentTimeMillis()));
        }
        if (fresh.containsKey(Topics.MISSION_DEVICES)) {
            reconciler.takeLists(fresh.get(Topics.MISSION_DEVICES));
        }
        if (fresh.containsKey(Topics.DEVICES)) {
            reconciler.take(read(fresh.get(Topics.DEVICES)));
        }
        if (!caughtUp && records.isCaughtUp()) {
            reconciler.forgetAllBut(statuses.keys());
            caughtUp = true;
        }
        for (Runnable next = events.poll(); next != null; next = events.poll()) {
            next.run();
        }
        statuses.retryFailed();
    }

    private static Map<String, DesiredDevice> read(Map<String, byte[]> records) {
        Map<String, DesiredDevice> devices = new LinkedHashMap<>();
        records.forEach((key, value) -> {
            try {
                devices.put(key, value == null ? null : DesiredDevice.read(value));
            } catch (UnreadableException e) {
                LOG.warn("the desired device {} cannot be read and is ignored: {}", key, e.getMessage());
            }
        });
        return devices;
    }

    /** Queues events of the fleet for the thread of the host. */
    private final class EventQueue implements FleetEvents {
        @Override
        public void up(String device) {
            events.add(() -> statusPublisher.up(device));
        }

        @Override
        public void failed(String device, int attempts, String reason) {
            events.add(() -> statusPublisher.failed(device, attempts, reason));
        }
    }
}
