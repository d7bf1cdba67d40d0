package io.furrow.control;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.TopologyTestDriver;
import org.apache.kafka.streams.test.TestRecord;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Runs the topology of the farm watch with records and time under the control of a test. */
final class FarmWatchFixture implements AutoCloseable {
    static final Instant START = Instant.parse("2026-03-01T08:00:00Z");
    static final String ROBOT = "robot-1";

    private final TopologyTestDriver driver = new TopologyTestDriver(
            WatchTopology.of(Duration.ofHours(1), WatchOptions.DEFAULT, new FiwareScope("farm", "/")),
            settings(),
            START);
    private Instant now = START;

    Instant now() {
        return now;
    }

    Set<String> stores() {
        return driver.getAllStateStores().keySet();
    }

    void encounter(String phase, double distance) {
        EntityBuilder entity = Entity.builder("Analytics:Collision:1", "Analytics:Collision")
                .text("encounter", "e-1")
                .text("phase", phase)
                .text("Device1_ID", ROBOT)
                .text("Device1_Mission", "m")
                .text("Device2_ID", "robot-2")
                .text("Device2_Mission", "")
                .number("distance", distance)
                .number("minDistance", distance);
        pipe(Topics.COLLISION, ROBOT + "-robot-2", entity.toBytes());
    }

    /** Pipes a window of half a minute that ends now, and returns it. */
    byte[] temperature(String field, double average, List<String> suspects) {
        return temperature(field, average, suspects, List.of());
    }

    byte[] temperature(String field, double average, List<String> suspects, List<String> types) {
        return temperature(field, average, suspects, types, "robust");
    }

    /** Pipes a window with too few devices to identify suspects. */
    void unverified(String field) {
        temperature(field, 18, List.of(), List.of(), "unverified");
    }

    void temperatureOfAClockAhead(String field, Duration ahead) {
        now = now.plus(ahead);
        temperature(field, 18, List.of());
        now = now.minus(ahead);
    }

    private byte[] temperature(
            String field, double average, List<String> suspects, List<String> types, String quality) {
        EntityBuilder entity = Entity.builder("Analytics:FieldTemperature:" + field, "Analytics:FieldTemperature")
                .text("field", field)
                .number("averageTemperature", average)
                .texts("suspects", suspects)
                .texts("suspectTypes", types)
                .text("quality", quality)
                .integer("windowStart", now.toEpochMilli() - 30_000)
                .integer("windowEnd", now.toEpochMilli());
        pipe(Topics.TEMPERATURE, field, entity.toBytes());
        return entity.toBytes();
    }

    void clockBehind(String device, long late) {
        pipe(Topics.CLOCKS, device, behind(device, late).toBytes());
    }

    /** @param interval after which the next report is expected */
    void clockBehind(String device, long late, Duration interval) {
        EntityBuilder entity = behind(device, late).integer("interval", interval.toMillis());
        pipe(Topics.CLOCKS, device, entity.toBytes());
    }

    private static EntityBuilder behind(String device, long late) {
        return Entity.builder("Analytics:ClockBehind:" + device, "Analytics:ClockBehind")
                .text("device", device)
                .text("Mission", "m")
                .integer("late", late);
    }

    void request(String manager, String members) {
        pipe(manager, null, "{'type':'request'," + members + "}");
    }

    void pipe(String topic, String key, String json) {
        pipe(topic, key, json.replace('\'', '"').getBytes(UTF_8));
    }

    void pipe(String topic, String key, byte[] value) {
        pipe(topic, "farm", key, value);
    }

    void pipe(String topic, String tenant, String key, byte[] value) {
        RecordHeaders headers = new RecordHeaders();
        Map.of(HeaderNames.SERVICE, tenant, HeaderNames.SERVICE_PATH, "/")
                .forEach((name, text) -> headers.add(name, text.getBytes(UTF_8)));
        pipe(topic, new TestRecord<>(key, value, headers, now));
    }

    void pipe(String topic, TestRecord<String, byte[]> record) {
        driver.createInputTopic(topic, new StringSerializer(), new ByteArraySerializer())
                .pipeInput(record);
    }

    void addDesired(String id, String type, boolean running) {
        addDesired(id, type, "m", running);
    }

    void addDesired(String id, String type, String mission, boolean running) {
        Long until = running ? null : Long.valueOf(now.toEpochMilli());
        var version = new DeviceVersion(id, "farm", "/", "north", mission, START.toEpochMilli(), until, 1, null);
        DesiredDevice device = DesiredDevice.simulated(
                version,
                type,
                type == null ? null : id,
                running,
                Duration.ofSeconds(10),
                NgsiJson.mapper().createObjectNode());
        pipe(Topics.DEVICES, version.key(), device.toBytes());
    }

    void report(EntityBuilder entity) {
        pipe(Topics.RAW, entity.id(), entity.toBytes());
    }

    void pass(Duration time) {
        now = now.plus(time);
        driver.advanceWallClockTime(time);
    }

    List<TestRecord<String, byte[]>> read(String topic) {
        return driver.createOutputTopic(topic, new StringDeserializer(), new ByteArrayDeserializer())
                .readRecordsToList();
    }

    List<String> heartbeats() {
        return read(FarmWatch.APPLICATION + "-device-heartbeats-repartition").stream()
                .map(TestRecord::key)
                .toList();
    }

    List<JsonNode> all(String topic) throws Exception {
        List<JsonNode> all = new ArrayList<>();
        for (TestRecord<String, byte[]> record : read(topic)) {
            all.add(NgsiJson.read(record.value()));
        }
        return all;
    }

    JsonNode newest(String topic) throws Exception {
        List<JsonNode> all = all(topic);
        assertThat(all).isNotEmpty();
        return all.get(all.size() - 1);
    }

    @Override
    public void close() {
        driver.close();
    }

    private static Properties settings() {
        Properties settings = new Properties();
        settings.setProperty(StreamsConfig.APPLICATION_ID_CONFIG, FarmWatch.APPLICATION);
        settings.setProperty(StreamsConfig.BOOTSTRAP_SERVERS_CONFIG, "unused:0");
        settings.setProperty(StreamsConfig.PROCESSING_GUARANTEE_CONFIG, StreamsConfig.EXACTLY_ONCE_V2);
        return settings;
    }
}
