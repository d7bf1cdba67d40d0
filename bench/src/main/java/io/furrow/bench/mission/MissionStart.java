package io.furrow.bench.mission;

import java.net.URI;
import java.time.Duration;
import java.util.HashSet;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.locks.LockSupport;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Starts a mission of thermometers through the REST API, and watches Kafka until each of them has reported. */
public final class MissionStart implements AutoCloseable {
    private static final Duration POLL_INTERVAL = Duration.ofMillis(20);
    private static final int POLLS = 500;
    private static final String DOMAIN = "domain";
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final ControlApi api;
    private final KafkaConsumer<String, byte[]> consumer;
    private final String domain;

    /**
     * Since the request was sent.
     *
     * @param answered until the control plane said that the mission is created
     * @param firstRaw until the first record of a device on {@code data.raw}
     * @param allRaw until there is one of each
     * @param firstRouted until the first one on the topic of the domain
     * @param running until the mission was running
     */
    public record Delays(
            Duration answered, Duration firstRaw, Duration allRaw, Duration firstRouted, Duration running) {}

    /**
     * Makes the domain.
     *
     * @param control base of the REST API
     * @param client settings of Kafka clients
     * @param domain a new one, whose topic is there
     */
    public MissionStart(URI control, Properties client, String domain) {
        this.api = new ControlApi(control, null);
        this.domain = domain;
        Properties settings = new Properties();
        settings.putAll(client);
        settings.setProperty("isolation.level", "read_committed");
        this.consumer = new KafkaConsumer<>(settings, new StringDeserializer(), new ByteArrayDeserializer());
        List<TopicPartition> all = List.of(Topics.RAW, Topics.realtime(domain), Topics.MISSIONS_STATUS).stream()
                .flatMap(this::partitions)
                .toList();
        consumer.assign(all);
        consumer.seekToEnd(all);
        all.forEach(consumer::position);
        api.send("POST", "/api/domains", NODES.objectNode().put(DOMAIN, domain));
    }

    /** Of a topic that was made just now a broker may know nothing yet. */
    private Stream<TopicPartition> partitions(String topic) {
        List<PartitionInfo> known = consumer.partitionsFor(topic);
        for (int looks = 0; known.isEmpty() && looks < POLLS; looks++) {
            LockSupport.parkNanos(POLL_INTERVAL.toNanos());
            known = consumer.partitionsFor(topic);
        }
        return known.stream().map(info -> new TopicPartition(topic, info.partition()));
    }

    /** A mission of this many devices, each with a measure every this often. */
    public record Plan(String mission, int devices, Duration period) {}

    /**
     * Starts a mission.
     *
     * @param timeout for each record that is waited for
     * @throws ControlPlaneException if it is refused, or nothing comes for that long
     */
    public Delays run(Plan plan, Duration timeout) {
        String mission = plan.mission();
        int devices = plan.devices();
        Seen seen = new Seen(mission, devices);
        api.send("POST", "/api/missions" + ControlApi.part(mission) + "/start", json(plan));
        seen.answered = seen.now();
        Duration last = seen.now();
        while (!seen.isComplete()) {
            for (ConsumerRecord<String, byte[]> record : consumer.poll(POLL_INTERVAL)) {
                if (seen.take(record)) {
                    last = seen.now();
                }
            }
            if (seen.now().minus(last).compareTo(timeout) > 0) {
                throw new ControlPlaneException(
                        "nothing more of mission %s for %d s: %d of %d devices have reported, it is %s"
                                .formatted(mission, timeout.toSeconds(), seen.reported.size(), devices, seen.state));
            }
        }
        return new Delays(seen.answered, seen.firstRaw, seen.allRaw, seen.firstRouted, seen.running);
    }

    /**
     * Stops it.
     *
     * @return how long it took until it was stopped
     */
    public Duration stop(String mission, Duration timeout) {
        Seen seen = new Seen(mission, 0);
        api.send("POST", "/api/missions" + ControlApi.part(mission) + "/stop", NODES.objectNode());
        Duration last = seen.now();
        while (!seen.state.equals("stopped")) {
            for (ConsumerRecord<String, byte[]> record : consumer.poll(POLL_INTERVAL)) {
                if (seen.take(record)) {
                    last = seen.now();
                }
            }
            if (seen.now().minus(last).compareTo(timeout) > 0) {
                throw new ControlPlaneException("mission %s is %s, and has not stopped within %d s of its last sign"
                        .formatted(mission, seen.state, timeout.toSeconds()));
            }
        }
        return seen.now();
    }

    private ObjectNode json(Plan plan) {
        ObjectNode json = NODES.objectNode().put(DOMAIN, domain);
        ObjectNode group = json.putArray("devices").addObject();
        group.put("type", "Thermometer")
                .put("simulated", true)
                .put("count", plan.devices())
                .put("period", plan.period().toString());
        var ring = group.putObject("area")
                .put("type", "Polygon")
                .putArray("coordinates")
                .addArray();
        double[][] corners = {{-3.6, 40.4}, {-3.59, 40.4}, {-3.59, 40.41}, {-3.6, 40.41}, {-3.6, 40.4}};
        for (double[] corner : corners) {
            ring.addArray().add(corner[0]).add(corner[1]);
        }
        return json;
    }

    @Override
    public void close() {
        consumer.close();
    }

    /** What has come of one mission. */
    private final class Seen {
        private final String mission;
        private final String prefix;
        private final int devices;
        private final long start = System.nanoTime();
        private final Set<String> reported = new HashSet<>();
        private Duration answered;
        private Duration firstRaw;
        private Duration allRaw;
        private Duration firstRouted;
        private Duration running;
        private String state = "unheard of";

        Seen(String mission, int devices) {
            this.mission = mission;
            this.devices = devices;
            this.prefix = "urn:ngsi-ld:Thermometer:" + mission + "-";
        }

        Duration now() {
            return Duration.ofNanos(System.nanoTime() - start);
        }

        boolean isComplete() {
            return allRaw != null && firstRouted != null && running != null;
        }

        /** @return whether it was something new of the mission */
        boolean take(ConsumerRecord<String, byte[]> record) {
            if (record.topic().equals(Topics.MISSIONS_STATUS)) {
                return mission.equals(record.key()) && record.value() != null && isStatus(record.value());
            }
            if (!record.key().startsWith(prefix) || !hasReported(record.value())) {
                return false;
            }
            if (!record.topic().equals(Topics.RAW)) {
                firstRouted = firstRouted == null ? now() : firstRouted;
                return false;
            }
            firstRaw = firstRaw == null ? now() : firstRaw;
            boolean fresh = reported.add(record.key());
            if (fresh && reported.size() == devices) {
                allRaw = now();
            }
            return fresh;
        }

        private boolean isStatus(byte[] value) {
            state = read(value).path("state").asText();
            running = running == null && state.equals("running") ? now() : running;
            return true;
        }

        /** A device that is only provisioned has no temperature yet. */
        private boolean hasReported(byte[] value) {
            return value != null
                    && read(value).path("Temperature").path("value").isNumber();
        }

        private static JsonNode read(byte[] value) {
            try {
                return NgsiJson.read(value);
            } catch (UnreadableException e) {
                throw new IllegalStateException("Furrow wrote what is no JSON", e);
            }
        }
    }
}
