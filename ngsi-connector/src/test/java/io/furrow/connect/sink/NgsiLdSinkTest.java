package io.furrow.connect.sink;

import java.util.List;

import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.connect.sink.FakeContextBroker.Reply;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class NgsiLdSinkTest extends SinkFixture {
    @BeforeEach
    void startTask() {
        start(
                "api", "ngsi-ld",
                "ngsi.ld.context", "http://example.org/c.jsonld",
                "delete.on.null", "true",
                "fiware.service", "farm");
    }

    @Test
    void writesPropertiesRelationshipsAndGeoProperties() throws Exception {
        task.put(List.of(record("barn1", 1_000, """
                {"id": "barn1", "type": "Barn",
                 "weight": {"type": "Number", "value": 1.50, "metadata": {
                    "unitCode": {"type": "Text", "value": "KGM"}, "accuracy": {"type": "Number", "value": 2},
                    "TimeInstant": {"type": "DateTime", "value": "2020-01-01T00:00:00Z"}}},
                 "built": {"type": "DateTime", "value": "1970-01-02T00:00:00Z", "metadata": {}},
                 "refOwner": {"type": "Relationship", "value": "urn:ngsi-ld:Person:1", "metadata": {}},
                 "near": {"type": "Relationship", "value": ["barn2", "urn:x:3"], "metadata": {}},
                 "location": {"type": "geo:point", "value": "40.1, -3.5", "metadata": {}},
                 "area": {"type": "geo:json", "value": {"type": "Point", "coordinates": [1, 2]}, "metadata": {}},
                 "none": {"type": "None", "value": null, "metadata": {}},
                 "dateModified": {"type": "DateTime", "value": "2020-01-01T00:00:00Z", "metadata": {}}}""")));

        assertThat(broker.requests).singleElement().satisfies(update -> {
            assertThat(update.path()).isEqualTo("/ngsi-ld/v1/entityOperations/upsert?options=update");
            assertThat(update.headers())
                    .containsEntry("ngsild-tenant", "farm")
                    .containsEntry("content-type", "application/json")
                    .containsEntry(
                            "link",
                            "<http://example.org/c.jsonld>; rel=\"http://www.w3.org/ns/json-ld#context\";"
                                    + " type=\"application/ld+json\"");
            assertThat(update.body()).isEqualTo(NgsiJson.mapper().readTree("""
                    [{"id": "urn:ngsi-ld:Barn:barn1", "type": "Barn",
                      "weight": {"type": "Property", "value": 1.50, "unitCode": "KGM",
                        "accuracy": {"type": "Property", "value": 2}, "observedAt": "1970-01-01T00:00:01Z"},
                      "built": {"type": "Property", "value": {"@type": "DateTime", "@value": "1970-01-02T00:00:00Z"},
                        "observedAt": "1970-01-01T00:00:01Z"},
                      "refOwner": {"type": "Relationship", "object": "urn:ngsi-ld:Person:1",
                        "observedAt": "1970-01-01T00:00:01Z"},
                      "near": {"type": "Relationship", "object": ["urn:ngsi-ld:near:barn2", "urn:x:3"],
                        "observedAt": "1970-01-01T00:00:01Z"},
                      "location": {"type": "GeoProperty", "value": {"type": "Point", "coordinates": [-3.5, 40.1]},
                        "observedAt": "1970-01-01T00:00:01Z"},
                      "area": {"type": "GeoProperty", "value": {"type": "Point", "coordinates": [1, 2]},
                        "observedAt": "1970-01-01T00:00:01Z"}}]"""));
        });
    }

    @Test
    void deletesAnAttributeWhoseValueBecomesNull() {
        task.put(List.of(record("urn:x:a", 1, "{'id':'urn:x:a','type':'T','x':1,'y':2}")));
        task.put(List.of(record("urn:x:a", 2, "{'id':'urn:x:a','type':'T','x':3,'y':null}")));
        assertThat(broker.value("urn:x:a", "x").asInt()).isEqualTo(3);
        assertThat(broker.entities.get("urn:x:a").has("y")).isFalse();
        assertThat(broker.requests.get(2).path()).isEqualTo("/ngsi-ld/v1/entities/urn%3Ax%3Aa/attrs/y");

        task.put(List.of(record("urn:x:a", 1, "{'id':'urn:x:a','type':'T','y':1}")));
        assertThat(broker.entities.get("urn:x:a").has("y")).as("it is older").isFalse();
        assertThat(context.reported).isEmpty();
    }

    @Test
    void goesOnWhereTheBrokerDeletesNoAttribute() {
        task.put(List.of(record("urn:x:a", 1, "{'id':'urn:x:a','type':'T','x':1,'y':2}")));
        broker.behaviour = update -> update.path().contains("/attrs/") ? new Reply(405, "no") : Reply.WRITTEN;

        task.put(List.of(record("urn:x:a", 2, "{'id':'urn:x:a','type':'T','x':3,'y':null}")));
        task.put(List.of(record("urn:x:b", 2)));

        assertThat(broker.value("urn:x:a", "x").asInt()).isEqualTo(3);
        assertThat(broker.entities).containsKey("urn:x:b");
        assertThat(context.reported)
                .singleElement()
                .satisfies(reported -> assertThat(reported.cause()).hasMessageContaining("'y' keeps its value"));
    }

    @Test
    void deletesTheAttributeWhenItsTokenIsAcceptedAgain() {
        task.put(List.of(record("urn:x:a", 1, "{'id':'urn:x:a','type':'T','x':1,'y':2}")));
        List<SinkRecord> cleared = List.of(record("urn:x:a", 2, "{'id':'urn:x:a','type':'T','x':3,'y':null}"));
        broker.behaviour = update -> update.path().contains("/attrs/") ? new Reply(401, "expired") : Reply.WRITTEN;
        assertThatThrownBy(() -> task.put(cleared)).isInstanceOf(RetriableException.class);
        broker.behaviour = update -> Reply.WRITTEN;
        task.put(cleared);

        assertThat(broker.entities.get("urn:x:a").has("y")).isFalse();
        assertThat(context.reported).isEmpty();
    }

    @Test
    void setsAsideWhatAMultiStatusAnswerRefusesAndNothingElse() {
        broker.behaviour = update -> new Reply(207, """
                {"success": ["urn:x:a", "urn:x:c"], "errors": [
                  {"entityId": "urn:x:b", "error": {"title": "Bad Request", "detail": "no such thing", "status": 400}}]}
                """.replace("\"urn:x:a\", \"urn:x:c\"", ""));

        task.put(List.of(record("urn:x:a", 1), record("urn:x:b", 1), record("urn:x:c", 1)));

        assertThat(broker.requests).hasSize(1);
        assertThat(broker.entities).containsOnlyKeys("urn:x:a", "urn:x:c");
        assertThat(context.reported).singleElement().satisfies(reported -> {
            assertThat(reported.record().key()).isEqualTo("urn:x:b");
            assertThat(reported.cause()).hasMessageContaining("no such thing");
        });
    }

    @Test
    void neverOverwritesWhatIsNewerAlsoAfterAStart() {
        broker.behaviour = update -> new Reply(201, "[]");
        task.put(List.of(record("7", 20)));
        restart();
        task.put(List.of(record("7", 10)));

        assertThat(broker.requests).hasSize(1);
        assertThat(broker.entities).containsOnlyKeys("urn:ngsi-ld:T:7");
    }

    @Test
    void deletesByIdAndScope() {
        task.put(List.of(record("urn:x:a", 1)));
        task.put(List.of(deletion("urn:x:a", 9)));

        assertThat(broker.entities).isEmpty();
        assertThat(broker.requests.get(1).headers()).containsEntry("ngsild-tenant", "farm");
    }

    private static SinkRecord record(String id, long time) {
        return record(id, time, "{\"id\": \"" + id + "\", \"type\": \"T\", \"x\": 1}");
    }

    private static SinkRecord record(String id, long time, String json) {
        return record(id, json.replace('\'', '"'), time);
    }
}
