package io.furrow.control;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.Set;

import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.TopologyTestDriver;
import org.apache.kafka.streams.test.TestRecord;

import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.model.control.CommandResult;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.unchecked.Unchecked;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Runs the topology of the managers with requests, reports of hosts and time under the control of a test. */
final class ManagerFixture implements AutoCloseable {
    static final Duration REQUEST_RETENTION = Duration.ofHours(1);
    static final Instant START = Instant.parse("2026-03-01T08:00:00Z");

    private final TopologyTestDriver driver;

    ManagerFixture() {
        this(false);
    }

    /** @param hasRecordings whether only missions listed on {@code service.recordings} can be replayed */
    ManagerFixture(boolean hasRecordings) {
        MissionSettings missions = new MissionSettings(Duration.ofSeconds(30), new FiwareScope("farm", "/"), false);
        ReplaySettings replays = ReplaySettings.DEFAULT.withMongo(hasRecordings ? "mongodb://unused" : null);
        driver = new TopologyTestDriver(ControlTopology.of(REQUEST_RETENTION, missions, replays), settings(), START);
    }

    void pass(Duration time) {
        driver.advanceWallClockTime(time);
    }

    Set<String> stores() {
        return driver.getAllStateStores().keySet();
    }

    int countRequestIds(String store) {
        int ids = 0;
        try (var all = driver.<String, byte[]>getWindowStore(store).all()) {
            while (all.hasNext()) {
                all.next();
                ids++;
            }
        }
        return ids;
    }

    /** Sends a request with these members, without a key. */
    void request(String manager, String members) {
        request(manager, null, "{'type':'request'," + members + "}");
    }

    void request(String topic, String key, String json) {
        pipe(topic, key, json.replace('\'', '"').getBytes(UTF_8));
    }

    void pipe(String topic, String key, byte[] value) {
        driver.createInputTopic(topic, new StringSerializer(), new ByteArraySerializer())
                .pipeInput(key, value);
    }

    List<TestRecord<String, byte[]>> read(String topic) {
        return driver.createOutputTopic(topic, new StringDeserializer(), new ByteArrayDeserializer())
                .readRecordsToList();
    }

    TestRecord<String, byte[]> only(String topic) {
        List<TestRecord<String, byte[]>> all = read(topic);
        assertThat(all).hasSize(1);
        return all.get(0);
    }

    /** Returns the newest state on {@code service.missions.status}. */
    String state(String mission) throws Exception {
        String state = null;
        for (TestRecord<String, byte[]> record : read(Topics.MISSIONS_STATUS)) {
            assertThat(record.key()).isEqualTo(mission);
            state = NgsiJson.read(record.value()).path("state").asText();
        }
        return state;
    }

    /** Reports a state for each device requested since the last call. Returns their number. */
    int hostAll(DeviceStatus.State state) throws Exception {
        List<TestRecord<String, byte[]>> requested = new ArrayList<>(read(Topics.DEVICES));
        for (TestRecord<String, byte[]> record : requested) {
            long sequence = DeviceVersion.read(record.value()).sequence();
            pipe(Topics.DEVICES_STATUS, record.key(), new DeviceStatus(sequence, state, null).toBytes());
        }
        return requested.size();
    }

    static String error(TestRecord<String, byte[]> record) {
        return response(record).error().orElseThrow();
    }

    static CommandResult response(TestRecord<String, byte[]> record) {
        return Unchecked.get(() -> CommandResult.read(record.value()));
    }

    static String text(byte[] bytes) {
        return new String(bytes, UTF_8);
    }

    private static Properties settings() {
        Properties settings = new Properties();
        settings.setProperty(StreamsConfig.APPLICATION_ID_CONFIG, "furrow-control-plane");
        settings.setProperty(StreamsConfig.BOOTSTRAP_SERVERS_CONFIG, "unused:0");
        settings.setProperty(StreamsConfig.PROCESSING_GUARANTEE_CONFIG, StreamsConfig.EXACTLY_ONCE_V2);
        return settings;
    }

    @Override
    public void close() {
        driver.close();
    }
}
