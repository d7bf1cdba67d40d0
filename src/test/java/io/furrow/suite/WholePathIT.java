package io.furrow.suite;

import java.io.ByteArrayOutputStream;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.kafka.field.FieldsTopic;
import io.furrow.launcher.command.DemoFarm;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class WholePathIT {
    /** Contains characters that the context broker rejects in most types of attributes. */
    private static final String NAME = "O'Brien's = \"the\" <field>; (north)";

    @AutoClose
    private static RunningSuite running;

    @BeforeAll
    static void startTheDemonstrationFarm() throws Exception {
        running = RunningSuite.start(null);
        DemoFarm.start(running.suite().control());
    }

    @Test
    void writesTheAverageOfAFieldAndTheSuspectThermometerIntoTheContextBroker() {
        await().untilAsserted(() -> {
            JsonNode average = running.ngsi().entity("Analytics:FieldTemperature:field-1");
            assertThat(average.at("/suspects/value")).hasSize(1);
            assertThat(average.at("/suspects/value/0").asText()).isEqualTo("urn:ngsi-ld:Thermometer:4");
            assertThat(average.at("/quality/value").asText()).isEqualTo("robust");
            assertThat(average.at("/averageTemperature/value").asDouble())
                    .isLessThan(average.at("/plainMean/value").asDouble());
        });
    }

    @Test
    void writesEachDomainAndMissionIntoTheContextBroker() {
        await().untilAsserted(() -> {
            JsonNode missions = running.ngsi().entities("type=Mission");
            assertThat(missions)
                    .hasSize(3)
                    .allSatisfy(mission ->
                            assertThat(mission.at("/status/value").asText()).isEqualTo("running"));
            assertThat(running.ngsi().entities("type=Domain")).hasSize(2);
        });
    }

    /** Imports a field as {@code ./furrow fields import} does. */
    @Test
    void averagesAFieldThatIsImportedAtRuntime() throws Exception {
        FieldsTopic fields = new FieldsTopic(running.suite().kafka().clientProperties());
        FieldVersion existing = fields.read().stream()
                .filter(field -> field.id().equals("field-1"))
                .findFirst()
                .orElseThrow();
        ObjectNode properties =
                existing.properties().deepCopy().put("name", NAME).put("Domain", "farm (north)");
        fields.write(List.of(new FieldVersion("imported", 0, existing.geometry(), properties)));

        await().untilAsserted(() -> {
            JsonNode average = running.ngsi().entity("Analytics:FieldTemperature:imported");
            assertThat(average.at("/quality/value").asText()).isEqualTo("robust");
            assertThat(average.at("/Domain/value").asText()).isEqualTo("farm (north)");
            assertThat(running.ngsi().entities("type=Analytics:Presence"))
                    .anySatisfy(presence ->
                            assertThat(presence.at("/fieldName/value").asText()).isEqualTo(NAME));
        });
    }

    @Test
    void writesTheEncounterOfTwoRobotsIntoTheContextBroker() {
        await().untilAsserted(() -> {
            JsonNode collision =
                    running.ngsi().entities("type=Analytics:Collision").path(0);
            assertThat(collision.at("/Device1_ID/value").asText()).isEqualTo("urn:ngsi-ld:Robot:1");
            assertThat(collision.at("/Device2_ID/value").asText()).isEqualTo("urn:ngsi-ld:Robot:2");
            assertThat(collision.at("/minDistance/value").asDouble()).isBetween(0.0, 5.0);
        });
    }

    @Tag("full")
    @Test
    void writesWhatTheRobotsHaveCoveredOfTheirFieldIntoTheContextBroker() {
        await().untilAsserted(() -> {
            JsonNode coverages = running.ngsi().entities("type=Analytics:Coverage");
            assertThat(coverages)
                    .extracting(coverage -> coverage.at("/device/value").asText())
                    .contains("", "urn:ngsi-ld:Robot:1", "urn:ngsi-ld:Robot:2");
            assertThat(coverages).anySatisfy(all -> {
                assertThat(all.at("/device/value").asText()).isEmpty();
                assertThat(all.at("/Mission/value").asText()).isEqualTo("weeding");
                assertThat(all.at("/field/value").asText()).isEqualTo("field-1");
                assertThat(all.at("/share/value").asDouble()).isBetween(0.01, 1.0);
                assertThat(all.at("/timeLeft/value").asLong()).isPositive();
            });
        });
    }

    @Test
    void routesEachMissionToItsTopicWithTheTimesOfAllHops() {
        try (TopicLog weeding = running.topic("data.farm.realtime.weeding");
                TopicLog dummy = running.topic("data.canary.realtime.dummy")) {
            await().untilAsserted(() -> {
                assertThat(weeding.records())
                        .filteredOn(record -> origin(record).equals("notification"))
                        .hasSizeGreaterThan(10);
                assertThat(dummy.records()).hasSizeGreaterThan(10);
            });
            assertThat(weeding.records()).allSatisfy(record -> {
                Entity entity = Entity.parse(record.value());
                assertThat(entity.text("Mission")).contains("weeding");
                assertThat(new String(record.key(), UTF_8)).isEqualTo(entity.id());
                // On a slow machine the query of a repair may be faster than the notification.
                assertThat(origin(record)).isIn("notification", "repair");
                assertThat(TopicLog.headers(record))
                        .containsKeys(
                                HeaderNames.CE_ID, HeaderNames.TS_DEVICE, HeaderNames.TS_SOURCE, HeaderNames.TS_INGEST)
                        .containsEntry(HeaderNames.CE_SPECVERSION, "1.0")
                        .containsEntry(HeaderNames.TS_DEVICE, Long.toString(record.timestamp()))
                        .containsEntry(HeaderNames.SERVICE, "farm");
            });
        }
    }

    private static String origin(ConsumerRecord<byte[], byte[]> record) {
        return TopicLog.headers(record).get(HeaderNames.ORIGIN);
    }

    @Test
    void storesEveryEventOfAMissionInMongo() {
        try (TopicLog weeding = running.topic("data.farm.realtime.weeding");
                StoredMissions missions = StoredMissions.open(running.suite().mongo())) {
            await().untilAsserted(() -> assertThat(weeding.records()).hasSizeGreaterThan(10));
            await().untilAsserted(() -> {
                ByteArrayOutputStream lines = new ByteArrayOutputStream();
                missions.export("weeding", lines, ignored -> {});
                String stored = lines.toString(UTF_8);
                assertThat(weeding.records().subList(0, 10))
                        .allSatisfy(record -> assertThat(stored)
                                .contains(TopicLog.headers(record).get(HeaderNames.CE_ID))
                                .contains("\"entity\":" + new String(record.value(), UTF_8)));
            });
        }
    }

    @Test
    void doesNotReadItsOwnResultsAsInput() {
        await().untilAsserted(() ->
                assertThat(running.ngsi().entities("typePattern=Analytics:.*")).isNotEmpty());
        try (TopicLog raw = running.topic("data.raw")) {
            await().untilAsserted(() -> assertThat(raw.records()).hasSizeGreaterThan(50));
            assertThat(raw.records())
                    .extracting(record -> Entity.parse(record.value()).type())
                    .doesNotContain("Analytics:FieldTemperature", "Analytics:Collision")
                    .contains("Thermometer", "Camera");
        }
    }
}
