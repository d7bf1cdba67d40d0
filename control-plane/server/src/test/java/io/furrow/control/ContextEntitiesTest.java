package io.furrow.control;

import java.time.Duration;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ContextEntitiesTest {
    private static final String DOMAIN = "{'domain':'north','name':'North','description':'Behind the \\\"barn\\\"',"
            + "'fields':['f1','f2'],'created':1,'changed':2,'sequence':1}";
    private static final String MISSION = "{'mission':'m','domain':'north','template':'thesis-demo@1','parts':1,"
            + "'deviceCount':3,'running':true,'start':5,'created':1,'sequence':2}";
    private static final Duration SECOND = Duration.ofSeconds(1);

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void publishesADomainWithItsMissionsAndFields() throws Exception {
        farm.pipe(Topics.DOMAINS, "north", DOMAIN);
        farm.pipe(Topics.MISSIONS, "m", MISSION);
        farm.temperature("f1", 18, List.of("t-1"));
        farm.temperature("f2", 20, List.of());
        farm.temperature("elsewhere", 40, List.of("t-9"));
        farm.pass(SECOND);

        TestRecord<String, byte[]> record = farm.read(Topics.CONTEXT).get(0);
        assertThat(record.key()).isEqualTo("urn:ngsi-ld:Domain:north");
        assertThat(header(record, HeaderNames.CE_TYPE)).isEqualTo("ngsi.entity.changed");
        assertThat(header(record, HeaderNames.SERVICE)).isEqualTo("farm");
        assertThat(header(record, HeaderNames.CE_ID)).hasSize(32);
        Entity entity = Entity.parse(record.value());
        assertThat(entity.type()).isEqualTo("Domain");
        assertThat(entity.text("description")).hasValue("Behind the \"barn\"");
        assertThat(entity.json().at("/description/type").asText()).isEqualTo("TextUnrestricted");
        assertThat(entity.number("averageTemperature")).hasValue(19.0);
        assertThat(entity.number("suspectCount")).hasValue(1.0);
        assertThat(entity.number("missionCount")).hasValue(1.0);
        assertThat(entity.number("fieldCount")).hasValue(2.0);
    }

    /** Devices of two tenants may be in one field. */
    @Test
    void countsTheAveragesOfAllTenants() throws Exception {
        farm.pipe(Topics.DOMAINS, "north", DOMAIN);
        byte[] window = farm.temperature("f1", 18, List.of("t-1"), List.of("Thermometer"));
        String other = new String(window, UTF_8).replace("18.0", "22.0");
        farm.pipe(Topics.TEMPERATURE, "other", "f1", other.getBytes(UTF_8));
        farm.pass(SECOND);
        JsonNode entity = farm.newest(Topics.CONTEXT);
        assertThat(value(entity, "averageTemperature").asDouble()).isEqualTo(20);
        assertThat(value(entity, "suspectCount").asInt()).isEqualTo(2);
        farm.pass(Duration.ofMinutes(62));
        assertThat(value(farm.newest(Topics.CONTEXT), "averageTemperature").isNull())
                .isTrue();
    }

    @Test
    void discardsAveragesAfterAnHour() throws Exception {
        farm.pipe(Topics.DOMAINS, "north", DOMAIN);
        farm.temperature("f1", 18, List.of());
        farm.pass(SECOND);
        assertThat(value(farm.newest(Topics.CONTEXT), "averageTemperature").asDouble())
                .isEqualTo(18);
        farm.pass(Duration.ofMinutes(62));
        assertThat(value(farm.newest(Topics.CONTEXT), "averageTemperature").isNull())
                .isTrue();
    }

    @Test
    void publishesAMissionWithProgressDevicesAndEncounters() throws Exception {
        farm.pipe(Topics.MISSIONS, "m", MISSION);
        farm.pipe(
                Topics.MISSIONS_STATUS,
                "m",
                "{'mission':'m','domain':'north','state':'running','since':5,'sequence':2,'devices':2,'confirmed':1,"
                        + "'missing':[{'id':'urn:ngsi-ld:Camera:m-2'}]}");
        farm.encounter("started", 3);
        farm.encounter("ongoing", 2);
        farm.pass(SECOND);

        JsonNode entity = farm.newest(Topics.CONTEXT);
        assertThat(entity.path("id").asText()).isEqualTo("urn:ngsi-ld:Mission:m");
        assertThat(value(entity, "status").asText()).isEqualTo("running");
        assertThat(value(entity, "progress").asDouble()).isEqualTo(0.5);
        assertThat(value(entity, "domain").asText()).isEqualTo("north");
        assertThat(value(entity, "deviceCount").asInt()).isEqualTo(3);
        assertThat(value(entity, "missingCount").asInt()).isEqualTo(1);
        assertThat(value(entity, "collisions").asInt()).isEqualTo(1);
        assertThat(value(entity, "openEncounters").asInt()).isEqualTo(1);
        assertThat(value(entity, "minDistance").asDouble()).isEqualTo(2);

        farm.encounter("ended", 4);
        farm.pass(SECOND);
        entity = farm.newest(Topics.CONTEXT);
        assertThat(value(entity, "openEncounters").asInt()).isZero();
        assertThat(value(entity, "collisions").asInt()).isEqualTo(1);
    }

    /** The context broker and Kafka would reject entities that grow with a mission. */
    @Test
    void boundsTheSizeOfAMission() throws Exception {
        String name = "m".repeat(64);
        farm.pipe(
                Topics.MISSIONS,
                name,
                "{'mission':'%s','domain':'north','parts':2,'deviceCount':10000,'running':true,'start':5,'created':1,'sequence':2}"
                        .formatted(name));
        String missing = IntStream.range(0, 100)
                .mapToObj(i -> "{'id':'urn:%s-%d','reason':'%s'}".formatted("x".repeat(190), i, "y".repeat(500)))
                .collect(Collectors.joining(","));
        farm.pipe(
                Topics.MISSIONS_STATUS,
                name,
                "{'mission':'%s','domain':'north','state':'running','since':5,'sequence':2,'devices':10000,'confirmed':1,'missing':[%s]}"
                        .formatted(name, missing));
        farm.pass(SECOND);

        assertThat(farm.newest(Topics.CONTEXT).toString()).hasSizeLessThan(2000).contains("9999");
    }

    @Test
    void resetsCountsAtANewStart() throws Exception {
        farm.pipe(Topics.MISSIONS, "m", MISSION);
        farm.encounter("started", 3);
        farm.pipe(Topics.MISSIONS, "m", MISSION.replace("'sequence':2", "'sequence':3"));
        farm.pass(SECOND);
        assertThat(value(farm.newest(Topics.CONTEXT), "collisions").asInt()).isEqualTo(1);
        farm.pipe(Topics.MISSIONS, "m", MISSION.replace("'start':5", "'start':6"));
        farm.pass(SECOND);
        assertThat(value(farm.newest(Topics.CONTEXT), "collisions").asInt()).isZero();
    }

    @Test
    void publishesOnlyChangesAtMostOnceASecond() {
        farm.pipe(Topics.DOMAINS, "north", DOMAIN);
        farm.pipe(Topics.MISSIONS, "m", MISSION);
        for (int i = 0; i < 100; i++) {
            farm.encounter("ongoing", 100 - i);
        }
        assertThat(farm.read(Topics.CONTEXT)).isEmpty();
        farm.pass(SECOND);
        assertThat(farm.read(Topics.CONTEXT)).hasSize(2);
        farm.encounter("ongoing", 50);
        farm.pipe(Topics.DOMAINS, "north", DOMAIN);
        farm.pass(SECOND);
        assertThat(farm.read(Topics.CONTEXT)).isEmpty();
    }

    @Test
    void publishesDeletions() {
        farm.pipe(Topics.DOMAINS, "north", DOMAIN);
        farm.pipe(Topics.MISSIONS, "m", MISSION);
        farm.pass(SECOND);
        farm.read(Topics.CONTEXT);
        farm.pipe(Topics.MISSIONS, "m", (byte[]) null);
        farm.pipe(Topics.DOMAINS, "north", (byte[]) null);
        farm.encounter("started", 1);
        farm.pass(SECOND);

        List<TestRecord<String, byte[]>> removed = farm.read(Topics.CONTEXT);
        assertThat(removed)
                .extracting(TestRecord::key)
                .containsExactlyInAnyOrder("urn:ngsi-ld:Domain:north", "urn:ngsi-ld:Mission:m");
        assertThat(removed).allSatisfy(record -> {
            assertThat(record.value()).isNull();
            assertThat(header(record, HeaderNames.CE_TYPE)).isEqualTo("ngsi.entity.deleted");
        });
        farm.pass(SECOND);
        assertThat(farm.read(Topics.CONTEXT)).isEmpty();
    }

    private static JsonNode value(JsonNode entity, String attribute) {
        assertThat(entity.path(attribute).has("value")).as(attribute).isTrue();
        return entity.path(attribute).path("value");
    }

    private static String header(TestRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }
}
