package io.furrow.control;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.TopologyTestDriver;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class AuditTopicTest {
    private static final Instant START = Instant.parse("2026-03-01T08:00:00Z");

    @AutoClose
    private final TopologyTestDriver driver = new TopologyTestDriver(
            ControlTopology.of(
                    Duration.ofHours(1),
                    new MissionSettings(Duration.ofMinutes(1), FiwareScope.DEFAULT, false),
                    ReplaySettings.DEFAULT),
            settings(),
            START);

    @Test
    void recordsUserCommandTimeAndResult() throws Exception {
        request(
                Topics.DOMAIN_MANAGER,
                "{'type':'request','requestId':'r-1','user':'ann','command':'create','domain':'north'}");
        request(
                Topics.MISSION_MANAGER,
                "{'type':'request','command':'stop','mission':'m','force':true,'devices':['a']}");

        List<JsonNode> entries = entries();
        assertThat(entries).hasSize(2);
        assertThat(entries.get(0))
                .isEqualTo(json("{'time':%d,'user':'ann','target':'service.domainmanager','command':'create',"
                        + "'about':{'domain':'north'},'result':'created','requestId':'r-1'}"));
        assertThat(entries.get(1))
                .isEqualTo(json("{'time':%d,'user':'kafka','target':'service.missionmanager','command':'stop',"
                        + "'about':{'mission':'m','force':true},'result':'error','error':'unknown-mission',"
                        + "'reason':'there is no mission \\'m\\''}".replace("\\'", "\u0001")));
    }

    @Test
    void recordsARepeatedCommandOnce() throws Exception {
        for (int i = 0; i < 3; i++) {
            request(Topics.DOMAIN_MANAGER, "{'type':'request','requestId':'r-1','domain':'north'}");
        }
        assertThat(entries()).hasSize(1);
    }

    @Test
    void recordsInvalidRequests() throws Exception {
        request(Topics.DOMAIN_MANAGER, "{'type':");
        request(Topics.DOMAIN_MANAGER, "[7]");
        request(
                Topics.DOMAIN_MANAGER,
                "{'type':'request','domain':'\\uD800','user':'" + "x".repeat(5000) + "','n':1e9999}");

        List<JsonNode> entries = entries();
        assertThat(entries)
                .extracting(entry -> entry.path("error").asText())
                .containsExactly("not-json", "not-a-request", "not-json");
        assertThat(entries).extracting(entry -> entry.path("user").asText()).containsOnly("kafka");
        assertThat(entries).allMatch(entry -> entry.path("about").isEmpty());
    }

    private List<JsonNode> entries() throws Exception {
        List<JsonNode> entries = new ArrayList<>();
        var topic = driver.createOutputTopic(Topics.AUDIT, new StringDeserializer(), new ByteArrayDeserializer());
        for (byte[] value : topic.readValuesToList()) {
            entries.add(NgsiJson.read(value));
        }
        return entries;
    }

    private void request(String topic, String request) {
        driver.createInputTopic(topic, new StringSerializer(), new ByteArraySerializer())
                .pipeInput((String) null, bytes(request));
    }

    private static byte[] bytes(String json) {
        return json.replace('\'', '"').getBytes(UTF_8);
    }

    private static JsonNode json(String template) throws Exception {
        String json =
                template.formatted(START.toEpochMilli()).replace('\'', '"').replace('\u0001', '\'');
        return NgsiJson.read(json.getBytes(UTF_8));
    }

    private static Properties settings() {
        Properties settings = new Properties();
        settings.setProperty(StreamsConfig.APPLICATION_ID_CONFIG, "furrow-control-plane");
        settings.setProperty(StreamsConfig.BOOTSTRAP_SERVERS_CONFIG, "unused:0");
        return settings;
    }
}
