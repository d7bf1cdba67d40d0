package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.entry;

class EntityEventTest {
    private static final Instant RECEIVED = Instant.parse("2026-11-21T01:10:00.250Z");

    @Test
    void hasTheHeadersOfTheContract() {
        var entity =
                Entity.builder("a", "T").integer("Time", 1_795_223_399_000L).build();
        EntityEvent event = EntityEvent.of(
                entity,
                FiwareScope.of("Agri", "/p"),
                RECEIVED,
                EventTimeRule.within(Duration.ofMinutes(5)),
                Origin.REPAIR);

        assertThat(event.headers("http://orion:1026"))
                .containsExactly(
                        entry(
                                "ce_id",
                                EventId.of(
                                        new FiwareScope("agri", "/p"),
                                        entity,
                                        event.time().time())),
                        entry("ce_source", "http://orion:1026"),
                        entry("ce_time", "2026-11-21T01:09:59Z"),
                        entry("ce_specversion", "1.0"),
                        entry("ce_type", "ngsi.entity.changed"),
                        entry("fiware-service", "agri"),
                        entry("fiware-servicepath", "/p"),
                        entry("origin", "repair"),
                        entry("ts-device", "1795223399000"),
                        entry("ts-source", "1795223400250"));
    }

    @Test
    void hasTheSameIdOnASecondReceiptWithATimeOfTheBroker() throws Exception {
        Entity entity = Entity.parse(
                "{\"id\":\"a\",\"x\":{\"value\":1},\"dateModified\":{\"value\":\"2026-11-21T01:09:00Z\"}}".getBytes());

        assertThat(received(entity, RECEIVED.plusSeconds(60)).id())
                .isEqualTo(received(entity, RECEIVED).id());
    }

    /** A measure of yesterday is sent today, in an entity that reported its position in between. */
    @Test
    void namesTheLaterAttributes() throws Exception {
        Entity entity = Entity.parse("""
                {"id": "a", "type": "T", "TimeInstant": {"value": "2026-11-20T01:00:00.000Z"},
                 "temp": {"value": 5, "metadata": {"TimeInstant": {"value": "2026-11-20T01:00:00.000Z"}}},
                 "Latitude": {"value": 1, "metadata": {"TimeInstant": {"value": "2026-11-21T01:00:00.000Z"}}},
                 "Longitude": {"value": 1, "metadata": {"TimeInstant": {"value": "2026-11-21T01:00:00.000Z"}}}}""".getBytes(UTF_8));

        assertThat(received(entity, RECEIVED).headers("s"))
                .containsEntry(HeaderNames.LATER_ATTRIBUTES, "Latitude,Longitude");
    }

    /** The agent stamps with the time of arrival if the device has its own attribute for the time. */
    @Test
    void comparesTheAttributesWithTheTimeInstantOfTheEntity() throws Exception {
        Entity entity = Entity.parse("""
                {"id": "a", "type": "T", "Time": {"value": 1795223399000},
                 "TimeInstant": {"value": "2026-11-21T01:10:00.000Z"},
                 "Latitude": {"value": 1, "metadata": {"TimeInstant": {"value": "2026-11-21T01:10:00.000Z"}}}}""".getBytes(UTF_8));

        assertThat(received(entity, RECEIVED).headers("s")).doesNotContainKey(HeaderNames.LATER_ATTRIBUTES);
    }

    /** After an outage, a robot sends a measure with its own old time; the agent stamps all with the time of arrival. */
    @ParameterizedTest
    @ValueSource(strings = {"Time", "dateObserved"})
    void takesTheAttributesOfABacklogForThoseOfItsEvents(String own) throws Exception {
        Entity entity = Entity.parse("""
                {"id": "a", "type": "T",
                 "%s": {"value": "2026-11-20T01:00:00Z", "metadata": {"TimeInstant": {"value": "2026-11-21T01:10:00.000Z"}}},
                 "Latitude": {"value": 1, "metadata": {"TimeInstant": {"value": "2026-11-21T01:10:00.000Z"}}}}""".formatted(own).getBytes(UTF_8));

        assertThat(received(entity, RECEIVED).headers("s")).doesNotContainKey(HeaderNames.LATER_ATTRIBUTES);
    }

    @ParameterizedTest
    @ValueSource(strings = {"Time", "dateObserved", "timestamp"})
    void comparesObservationsWithTheDevicesTimeIfThereIsNoOtherStamp(String own) throws Exception {
        Entity entity = Entity.ofAnyForm(NgsiJson.read("""
                {"id": "a", "type": "T", "%s": {"type": "Property", "value": "2026-11-21T01:00:01Z"},
                 "temp": {"type": "Property", "value": 5, "observedAt": "2026-11-21T01:00:01.900Z"},
                 "location": {"type": "GeoProperty", "value": {"type": "Point", "coordinates": [1, 2]},
                              "observedAt": "2026-11-21T01:00:02Z"}}""".formatted(own).getBytes(UTF_8)));

        assertThat(received(entity, RECEIVED).headers("s")).containsEntry(HeaderNames.LATER_ATTRIBUTES, "location");
    }

    @ParameterizedTest
    @CsvSource({
        "2026-11-21T00:00:00Z/2026-11-21T01:00:00Z, 2026-11-21T00:37:20Z, 2026-11-21T01:01:00Z",
        "2026-11-21T00:37:00Z, 2026-11-21T00:37:20Z, 2026-11-21T00:38:00Z"
    })
    void takesWhatWasObservedInTheIntervalOrMinuteForThisMeasure(String measure, String within, String later)
            throws Exception {
        Entity entity = Entity.ofAnyForm(
                NgsiJson.read("""
                {"id": "a", "type": "T", "dateObserved": {"type": "Property", "value": "%s"},
                 "location": {"type": "GeoProperty", "value": {"type": "Point", "coordinates": [1, 2]}, "observedAt": "%s"},
                 "temp": {"type": "Property", "value": 5, "observedAt": "%s"}}""".formatted(measure, within, later).getBytes(UTF_8)));

        assertThat(received(entity, RECEIVED).headers("s")).containsEntry(HeaderNames.LATER_ATTRIBUTES, "temp");
    }

    /** As of a device that started without its time; the event has the time of its receipt. */
    @ParameterizedTest
    @ValueSource(strings = {"2026-11-21T00:00:00.000Z", "2026-11-21T01:12:00.000Z"})
    void namesNoLaterAttributesIfTheTimeInstantCannotBeTrue(String stamp) throws Exception {
        Entity entity = Entity.parse("""
                {"id": "a", "type": "T", "TimeInstant": {"value": "1970-01-01T00:01:40Z"},
                 "Latitude": {"value": 1, "metadata": {"TimeInstant": {"value": "%s"}}}}""".formatted(stamp).getBytes(UTF_8));

        assertThat(received(entity, RECEIVED).headers("s")).doesNotContainKey(HeaderNames.LATER_ATTRIBUTES);
    }

    @Test
    void comparesTheAttributesWithTheTimeOfTheDeviceIfTheTimeInstantIsEarlier() throws Exception {
        Entity entity = Entity.parse("""
                {"id": "a", "type": "T", "Time": {"value": "2026-11-21T01:09:59Z"},
                 "TimeInstant": {"value": "1970-01-01T00:01:40Z"},
                 "Latitude": {"value": 1, "metadata": {"TimeInstant": {"value": "2026-11-21T01:09:59Z"}}}}""".getBytes(UTF_8));

        assertThat(received(entity, RECEIVED).headers("s")).doesNotContainKey(HeaderNames.LATER_ATTRIBUTES);
    }

    private static EntityEvent received(Entity entity, Instant when) {
        return EntityEvent.of(
                entity, FiwareScope.DEFAULT, when, EventTimeRule.within(Duration.ofMinutes(5)), Origin.NOTIFICATION);
    }
}
