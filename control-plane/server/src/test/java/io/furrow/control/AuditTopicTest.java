package io.furrow.control;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class AuditTopicTest {
    @AutoClose
    private final ManagerFixture farm = new ManagerFixture();

    @Test
    void recordsUserCommandTimeAndResult() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-1','user':'ann','command':'create','domain':'north'");
        farm.request(Topics.MISSION_MANAGER, "'command':'stop','mission':'m','force':true,'devices':['a']");

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

    /** The answers on the topics are created and deleted. */
    @Test
    void recordsStartsAndStopsByTheirEffect() throws Exception {
        long later = ManagerFixture.START.toEpochMilli() + 60_000;
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'north'");
        farm.request(Topics.MISSION_MANAGER, "'command':'start','mission':'m','domain':'north'");
        farm.request(Topics.MISSION_MANAGER, "'command':'stop','mission':'m'");
        farm.request(Topics.MISSION_MANAGER, "'command':'start','mission':'m','start':" + later);
        farm.request(Topics.MISSION_MANAGER, "'command':'stop','mission':'m','dryRun':true");
        farm.request(Topics.MISSION_MANAGER, "'command':'delete','mission':'m'");

        List<JsonNode> entries = entries();
        assertThat(entries)
                .extracting(entry -> entry.path("result").asText())
                .containsExactly("created", "started", "stopped", "scheduled", "dry-run", "deleted");
        assertThat(entries.get(3).at("/about/start").asLong()).isEqualTo(later);
    }

    @Test
    void recordsARepeatedCommandOnce() throws Exception {
        for (int i = 0; i < 3; i++) {
            farm.request(Topics.DOMAIN_MANAGER, "'requestId':'r-1','domain':'north'");
        }
        assertThat(entries()).hasSize(1);
    }

    @Test
    void recordsInvalidRequests() throws Exception {
        farm.request(Topics.DOMAIN_MANAGER, null, "{'type':");
        farm.request(Topics.DOMAIN_MANAGER, null, "[7]");
        farm.request(Topics.DOMAIN_MANAGER, "'domain':'\\uD800','user':'" + "x".repeat(5000) + "','n':1e9999");

        List<JsonNode> entries = entries();
        assertThat(entries)
                .extracting(entry -> entry.path("error").asText())
                .containsExactly("not-json", "not-a-request", "not-json");
        assertThat(entries).extracting(entry -> entry.path("user").asText()).containsOnly("kafka");
        assertThat(entries).allMatch(entry -> entry.path("about").isEmpty());
    }

    private List<JsonNode> entries() throws Exception {
        List<JsonNode> entries = new ArrayList<>();
        for (TestRecord<String, byte[]> record : farm.read(Topics.AUDIT)) {
            entries.add(NgsiJson.read(record.value()));
        }
        return entries;
    }

    private static JsonNode json(String template) throws Exception {
        String json = template.formatted(ManagerFixture.START.toEpochMilli())
                .replace('\'', '"')
                .replace('\u0001', '\'');
        return NgsiJson.read(json.getBytes(UTF_8));
    }
}
