package io.furrow.model.ngsi;

import java.io.IOException;
import java.io.InputStream;
import java.util.List;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class NgsiLdTest {
    /** A line of {@code ngsi-ld.jsonl}: an entity as an NGSI-LD broker reports it, and the expected result. */
    record Case(String name, JsonNode reported, JsonNode entity) {
        @Override
        public String toString() {
            return name;
        }
    }

    static Stream<Case> cases() throws Exception {
        try (InputStream lines = NgsiLdTest.class.getResourceAsStream("ngsi-ld.jsonl")) {
            return new String(lines.readAllBytes(), UTF_8)
                            .lines()
                            .map(NgsiLdTest::json)
                            .map(line ->
                                    new Case(line.get("case").textValue(), line.get("reported"), line.get("entity")))
                            .toList()
                            .stream();
        }
    }

    @ParameterizedTest
    @MethodSource("cases")
    void readsAnEntityOfANotification(Case each) throws Exception {
        String body = """
                {"id": "urn:n:1", "type": "Notification", "subscriptionId": "urn:s:1", "notifiedAt": "2026-11-21T00:00:00Z",
                 "data": [%s]}""".formatted(each.reported);

        Notification notification = read(body);

        assertThat(notification.rejected()).isEmpty();
        assertThat(notification.subscriptionId()).contains("urn:s:1");
        assertThat(notification.entities())
                .singleElement()
                .satisfies(entity -> assertThat(entity.json().toString()).isEqualTo(each.entity.toString()));
    }

    /** The order of a list is irrelevant. */
    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "{'value':21.5,'observedAt':'2026-11-26T12:33:00Z'},{'value':19,'observedAt':'2026-11-26T12:32:00Z'}|21.5|2026-11-26T12:33:00Z",
                "{'value':19,'observedAt':'2026-11-26T12:32:00Z'},{'value':21.5,'observedAt':'2026-11-26T12:33:00+00:00'}|21.5|2026-11-26T12:33:00+00:00",
                "{'type':'Property','value':3,'modifiedAt':'2026-11-26T12:33:00Z'},{'type':'Property','value':2,'modifiedAt':'2026-11-26T12:32:00Z'}|3|",
                "{'type':'Property','value':3,'datasetId':'urn:d','observedAt':'2026-11-26T12:40:00Z'},{'value':1,'observedAt':'2026-11-26T12:33:00Z'},{'value':2,'observedAt':'2026-11-26T12:30:00Z'}|1|2026-11-26T12:40:00Z",
                "{'type':'Property','value':3},{'type':'Property','value':2}|2|"
            })
    void selectsTheNewestOfSeveralInstances(String instances, String value, String time) throws Exception {
        Entity entity = NgsiLdEntity.read(json("{'id':'a','type':'T','@context':'c','t':[%s]}"
                .formatted(instances)
                .replace('\'', '"')));

        assertThat(entity.value("t").orElseThrow()).hasToString(value);
        assertThat(entity.text("TimeInstant").orElse(null)).isEqualTo(time);
    }

    @ParameterizedTest
    @MethodSource("cases")
    void readsEntitiesThatAllLaterReadersAccept(Case each) throws Exception {
        Entity entity = NgsiLdEntity.read(each.reported);

        assertThat(Entity.parse(entity.toBytes())).isEqualTo(entity);
    }

    @Test
    void readsTheEntitiesOfAGeoJsonNotification() throws Exception {
        Notification notification = read("""
                {"id": "urn:n:1", "type": "Notification", "data": {"type": "FeatureCollection", "features": [
                  {"id": "a", "type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]},
                   "properties": {"type": "T", "t": {"type": "Property", "value": 3}}}]}}""");

        assertThat(notification.entities())
                .extracting(entity -> entity.json().toString())
                .containsExactly(
                        "{\"id\":\"a\",\"type\":\"T\",\"t\":{\"type\":\"Number\",\"value\":3,\"metadata\":{}}}");
    }

    @ParameterizedTest
    @CsvSource({
        "2026-05-01T10:00:00.500Z, 2026-05-01T10:00:00Z",
        "2026-05-01T10:00:00Z, 2026-05-01T11:30:00+02:00",
        "2026-05-01T10:00:00Z, yesterday"
    })
    void hasTheTimeOfItsNewestObservationInAllFormats(String newest, String other) throws Exception {
        for (List<String> times : List.of(List.of(newest, other), List.of(other, newest))) {
            Entity entity = read("""
                    {"id": "a", "type": "T", "@context": [], "t": {"value": 1, "observedAt": "%s"},
                     "u": {"value": 2, "observedAt": "%s"}}""".formatted(times.toArray())).entities().get(0);

            assertThat(entity.text("TimeInstant")).contains(newest);
        }
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "{\"id\": \"a\", \"type\": \"T\", \"@context\": [], \"t\": {\"value\": 1, \"observedAt\": \"2026-11-21T00:00:00Z\"}}",
                "{\"id\": \"a\", \"type\": \"T\", \"r\": {\"type\": \"Relationship\", \"object\": \"b\"}}"
            })
    void detectsABareEntityByItsShape(String body) throws Exception {
        assertThat(read(body).entities().get(0).json().findValue("metadata")).isNotNull();
        assertThat(read(body).entities().get(0).json().has("@context")).isFalse();
    }

    @Test
    void keepsAnNgsiV2EntityWithTypesOfNgsiLd() throws Exception {
        String body =
                "{\"id\":\"a\",\"type\":\"Notification\",\"r\":{\"type\":\"Relationship\",\"value\":\"b\",\"metadata\":{}},"
                        + "\"p\":{\"type\":\"Property\",\"value\":1,\"metadata\":{}}}";

        assertThat(read(body).entities().get(0).json().toString()).isEqualTo(body);
    }

    @Test
    void rejectsOnlyTheUnreadableEntity() throws Exception {
        Notification notification = read("""
                {"type": "Notification", "data": [{"id": "a", "type": "T"}, {"type": "T"}, 7, {"id": "b", "type": 3}]}""");

        assertThat(notification.entities()).extracting(Entity::id).isEqualTo(List.of("a"));
        assertThat(notification.rejected())
                .extracting(Notification.Rejected::reason)
                .containsOnly(Reason.NOT_AN_ENTITY)
                .hasSize(3);
    }

    private static Notification read(String body) throws UnreadableException {
        return Notification.read(body.getBytes(UTF_8), null);
    }

    private static JsonNode json(String line) {
        try {
            return NgsiJson.read(line.getBytes(UTF_8));
        } catch (UnreadableException e) {
            throw new java.io.UncheckedIOException(new IOException(line, e));
        }
    }

    /** The place was reported once; both attributes of the second entity were reported together. */
    @Test
    void hasTheTimeOfAnObservationOnlyIfNoOtherAttributeIsOfALaterReport() throws Exception {
        String entity = """
                {"id": "a", "type": "T", "@context": [],
                 "location": {"value": 1, "observedAt": "2026-11-14T08:00:00Z", "modifiedAt": "%s"},
                 "temperature": {"value": 21, "modifiedAt": "2026-11-21T01:09:59Z"}}""";

        assertThat(read(entity.formatted("2026-11-14T08:00:01Z"))
                        .entities()
                        .get(0)
                        .value("TimeInstant"))
                .isEmpty();
        assertThat(read(entity.formatted("2026-11-21T01:09:59Z"))
                        .entities()
                        .get(0)
                        .value("TimeInstant"))
                .isPresent();
    }
}
