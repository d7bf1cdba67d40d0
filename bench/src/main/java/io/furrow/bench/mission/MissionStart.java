package io.furrow.bench.mission;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashSet;
import java.util.Properties;
import java.util.Set;
import java.util.function.BooleanSupplier;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.bench.frame.TopicReader;
import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlPlaneException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Starts a mission of thermometers through the REST API, and reads Kafka until each of them has reported. */
public final class MissionStart implements AutoCloseable {
    private static final Duration POLL_INTERVAL = Duration.ofMillis(20);
    private static final String AREA =
            "{\"type\":\"Polygon\",\"coordinates\":[[[-3.6,40.4],[-3.59,40.4],[-3.59,40.41],[-3.6,40.41],[-3.6,40.4]]]}";

    private final ControlApi api;
    private final TopicReader reader;
    private final String domain;

    /**
     * Delays since the request was sent.
     *
     * @param answered until the control plane answered that the mission is created
     * @param firstRaw until the first record of a device on {@code data.raw}
     * @param allRaw until there is one of each
     * @param firstRouted until the first one on the topic of the domain
     * @param running until the mission was running
     */
    public record Delays(
            Duration answered, Duration firstRaw, Duration allRaw, Duration firstRouted, Duration running) {}

    /**
     * Creates the domain.
     *
     * @param control base of the REST API
     * @param client settings of Kafka clients
     * @param domain a new one, whose topic exists
     */
    public MissionStart(URI control, Properties client, String domain) {
        this.api = new ControlApi(control, null);
        this.domain = domain;
        this.reader = TopicReader.fromEnd(
                client, TopicReader.COMMITTED, Topics.RAW, Topics.realtime(domain), Topics.MISSIONS_STATUS);
        api.send("POST", "/api/domains", JsonNodeFactory.instance.objectNode().put("domain", domain));
    }

    /** A mission of this many devices, each with one measure per period. */
    public record Plan(String mission, int devices, Duration period) {}

    /**
     * Starts a mission.
     *
     * @param timeout for each record
     * @throws ControlPlaneException if it is refused, or no record arrives within the timeout
     */
    public Delays run(Plan plan, Duration timeout) {
        Seen seen = new Seen(plan.mission(), plan.devices());
        api.send("POST", "/api/missions" + ControlApi.part(plan.mission()) + "/start", json(plan));
        seen.answered = seen.now();
        seen.await(seen::isComplete, timeout);
        return new Delays(seen.answered, seen.firstRaw, seen.allRaw, seen.firstRouted, seen.running);
    }

    /**
     * Stops it.
     *
     * @return the time that this took
     */
    public Duration stop(String mission, Duration timeout) {
        Seen seen = new Seen(mission, 0);
        api.send("POST", "/api/missions" + ControlApi.part(mission) + "/stop", JsonNodeFactory.instance.objectNode());
        seen.await(() -> seen.state.equals("stopped"), timeout);
        return seen.now();
    }

    private ObjectNode json(Plan plan) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("domain", domain);
        ObjectNode group = json.putArray("devices").addObject();
        group.put("type", "Thermometer")
                .put("simulated", true)
                .put("count", plan.devices())
                .put("period", plan.period().toString());
        group.set("area", read(AREA.getBytes(StandardCharsets.UTF_8)));
        return json;
    }

    private static JsonNode read(byte[] value) {
        try {
            return NgsiJson.read(value);
        } catch (UnreadableException e) {
            throw new IllegalStateException("Furrow wrote what is not JSON", e);
        }
    }

    @Override
    public void close() {
        reader.close();
    }

    /** The records of one mission so far. */
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

        void await(BooleanSupplier done, Duration timeout) {
            Duration last = now();
            while (!done.getAsBoolean()) {
                for (ConsumerRecord<byte[], byte[]> record : reader.poll(POLL_INTERVAL)) {
                    if (take(record.topic(), TopicReader.text(record.key()), record.value())) {
                        last = now();
                    }
                }
                if (now().minus(last).compareTo(timeout) > 0) {
                    throw new ControlPlaneException(
                            "nothing more of mission %s for %d s: %d of %d devices have reported, it is %s"
                                    .formatted(mission, timeout.toSeconds(), reported.size(), devices, state));
                }
            }
        }

        /** @return whether it was a new step of the mission */
        private boolean take(String topic, String key, byte[] value) {
            if (value == null) {
                return false;
            }
            if (topic.equals(Topics.MISSIONS_STATUS)) {
                if (!mission.equals(key)) {
                    return false;
                }
                state = read(value).path("state").asText();
                running = running == null && state.equals("running") ? now() : running;
                return true;
            }
            // A provisioned device without a report has no temperature yet.
            if (!key.startsWith(prefix)
                    || !read(value).path("Temperature").path("value").isNumber()) {
                return false;
            }
            if (!topic.equals(Topics.RAW)) {
                firstRouted = firstRouted == null ? now() : firstRouted;
                return false;
            }
            firstRaw = firstRaw == null ? now() : firstRaw;
            boolean fresh = reported.add(key);
            if (fresh && reported.size() == devices) {
                allRaw = now();
            }
            return fresh;
        }
    }
}
