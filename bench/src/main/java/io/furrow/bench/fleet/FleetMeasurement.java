package io.furrow.bench.fleet;

import java.io.IOException;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.TopicFiller;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Requests devices on {@code service.devices}, runs them by a host in its own JVM, and counts their reports. */
final class FleetMeasurement {
    private static final Duration TIMEOUT = Duration.ofMinutes(3);
    private static final Duration POLL = Duration.ofMillis(100);
    /** Least share of the measures due, since the interval cuts some at its edges. */
    private static final double COMPLETE = 0.99;

    private final FleetBench plan;
    private final Engines engines;
    private final URI mqtt;

    FleetMeasurement(FleetBench plan, Engines engines, URI mqtt) {
        this.plan = plan;
        this.engines = engines;
        this.mqtt = mqtt;
    }

    /**
     * Adds a row. Delays count from when a measure was due to its arrival at a subscriber, which includes the broker; memory is the peak
     * of the whole process.
     *
     * @return whether all devices reported the measures due, except at the edges of the interval
     * @throws IOException if the devices do not come up
     */
    boolean run(Figures figures) throws Exception {
        Map<String, String> compacted = Map.of("cleanup.policy", "compact");
        Engines.makeTopics(engines.client(), 1, compacted, Topics.DEVICES, Topics.DEVICES_STATUS, Topics.FIELDS);
        try (HostProcess host = HostProcess.start(plan.heap, engines.bootstrapServers(), mqtt, engines.folder("."));
                MeasureListener listener = new MeasureListener(mqtt)) {
            long begun = System.nanoTime();
            publish();
            awaitRunning(begun);
            double untilAllRun = (System.nanoTime() - begun) / 1e9;
            TimeUnit.SECONDS.sleep(plan.warmup);
            Duration cpu = host.cpu();
            long from = System.nanoTime();
            listener.begin();
            TimeUnit.SECONDS.sleep(plan.seconds);
            listener.end();
            double seconds = (System.nanoTime() - from) / 1e9;
            double used = host.cpu().minus(cpu).toNanos() / 1e9;
            long due = (long) (plan.devices * seconds * 1000 / plan.period);
            int silent = plan.devices - listener.devices();
            figures.add(
                    "all run after s",
                    untilAllRun,
                    "measures/s",
                    (double) listener.arrived() / plan.seconds,
                    "due/s",
                    (double) due / plan.seconds,
                    "silent devices",
                    silent,
                    "due to subscriber p50 ms",
                    listener.delay(50),
                    "p99 ms",
                    listener.delay(99),
                    "% of a core",
                    100 * used / seconds,
                    "MB of process",
                    host.peakMb());
            return silent == 0 && listener.arrived() >= due * COMPLETE;
        }
    }

    private void publish() {
        try (TopicFiller filler = new TopicFiller(engines.client(), Map.of())) {
            for (int i = 0; i < plan.devices; i++) {
                DesiredDevice device = device(i);
                byte[] key = device.version().key().getBytes(StandardCharsets.UTF_8);
                filler.send(new ProducerRecord<>(Topics.DEVICES, key, device.toBytes()));
            }
        }
    }

    private DesiredDevice device(int number) {
        String mission = FleetBench.mission(number % plan.missions);
        String id = "urn:ngsi-ld:Thermometer:" + mission + "-" + (number / plan.missions + 1);
        DeviceVersion version = new DeviceVersion(
                id, "bench", "/", "bench", mission, System.currentTimeMillis(), null, number + 1L, null);
        ObjectNode settings = NgsiJson.mapper().createObjectNode();
        settings.putArray("path").addArray().add(-3.5 + number % 100 / 10_000d).add(40.3 + number / 100 / 10_000d);
        return DesiredDevice.simulated(version, "Thermometer", id, true, Duration.ofMillis(plan.period), settings);
    }

    private void awaitRunning(long begun) throws IOException, UnreadableException {
        Set<String> running = new HashSet<>();
        List<String> failures = new ArrayList<>();
        try (CommittedReader<String> reader = CommittedReader.open(engines.client(), Topics.DEVICES_STATUS)) {
            while (running.size() < plan.devices) {
                for (ConsumerRecord<String, byte[]> each : reader.poll(POLL)) {
                    DeviceStatus status = DeviceStatus.read(each.value());
                    if (status.state() == DeviceStatus.State.RUNNING) {
                        running.add(each.key());
                    } else {
                        failures.add(status.reason());
                    }
                }
                if (!failures.isEmpty() || System.nanoTime() - begun > TIMEOUT.toNanos()) {
                    throw new IOException("%d of %d devices run after %d s%s; see %s"
                            .formatted(
                                    running.size(),
                                    plan.devices,
                                    (System.nanoTime() - begun) / 1_000_000_000,
                                    failures.isEmpty() ? "" : ", one says: " + failures.get(0),
                                    engines.folder("host.log")));
                }
            }
        }
    }
}
