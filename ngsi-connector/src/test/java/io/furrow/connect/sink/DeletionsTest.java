package io.furrow.connect.sink;

import java.util.List;
import java.util.stream.IntStream;

import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.sink.FakeContextBroker.Reply;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Deletions go to the context broker in batches; those of a batch are deleted, absent or refused each for itself. */
class DeletionsTest extends SinkFixture {
    private static final int MANY = 250;

    @ParameterizedTest
    @ValueSource(strings = {"ngsi-v2", "ngsi-ld"})
    void goInBatches(String api) {
        startOf(api);
        task.put(entities());
        broker.requests.clear();

        task.put(deletions());

        assertThat(broker.entities).isEmpty();
        assertThat(broker.requests)
                .hasSize(3)
                .allSatisfy(request -> assertThat(request.size()).isLessThanOrEqualTo(100));
        assertThat(context.reported).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"ngsi-v2", "ngsi-ld"})
    void countEntitiesThatAreGoneAlreadyAsDeleted(String api) {
        startOf(api);
        task.put(entities());
        broker.entities.keySet().removeIf(id -> id.endsWith("7"));
        broker.requests.clear();

        task.put(deletions());

        assertThat(broker.entities).isEmpty();
        assertThat(broker.requests).hasSize(3);
        assertThat(context.reported).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"ngsi-v2", "ngsi-ld"})
    void needNoRequestForEachEntityWhenAllAreGone(String api) {
        startOf(api);

        task.put(deletions());

        assertThat(broker.requests).hasSize(3);
        assertThat(context.reported).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"ngsi-v2", "ngsi-ld"})
    void setTheOneAsideThatIsRefused(String api) {
        startOf(api);
        task.put(entities());
        broker.behaviour =
                update -> (update.path() + update.body()).replace("%3A", ":").contains("urn:x:77\"")
                                || update.path().endsWith("77")
                        ? new Reply(400, "no, not this one")
                        : Reply.WRITTEN;

        task.put(deletions());

        assertThat(broker.entities).containsOnlyKeys("urn:x:77");
        assertThat(context.reported).singleElement().satisfies(reported -> {
            assertThat(reported.record().key()).isEqualTo("urn:x:77");
            assertThat(reported.cause()).hasMessageContaining("no, not this one");
        });
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "ngsi-v2 | <html>nginx</html>",
                "ngsi-ld | <html>nginx</html>",
                "ngsi-v2 | ''",
                "ngsi-ld | ''",
                "ngsi-v2 | {\"timestamp\": 1, \"status\": 404, \"error\": \"Not Found\", \"path\": \"/v2/op/update\"}",
                "ngsi-ld | {\"timestamp\": 1, \"status\": 404, \"error\": \"Not Found\", \"path\": \"/v2/op/update\"}",
                "ngsi-v2 | {\"error\": {\"code\": \"NOT_FOUND\", \"message\": \"The requested URL was not found\"}}",
                "ngsi-ld | {\"error\": {\"code\": \"NOT_FOUND\", \"message\": \"The requested URL was not found\"}}"
            })
    void areTriedAgainWhereAProxyAnswersForTheContextBroker(String api, String answer) {
        startOf(api);
        task.put(entities());
        broker.behaviour = update -> new Reply(404, answer);

        assertThatThrownBy(() -> task.put(deletions().subList(0, 1))).isInstanceOf(RetriableException.class);
        assertThatThrownBy(() -> task.put(deletions())).isInstanceOf(RetriableException.class);

        assertThat(broker.entities).hasSize(MANY);
        broker.behaviour = update -> Reply.WRITTEN;
        task.put(deletions());
        assertThat(broker.entities).isEmpty();
    }

    /** The id is all that one deletion needs. */
    @Test
    void goAloneWhereThereIsOne() {
        startOf("ngsi-v2");

        task.put(deletions().subList(0, 1));

        assertThat(broker.requests)
                .singleElement()
                .satisfies(request -> assertThat(request.method()).isEqualTo("DELETE"));
    }

    @Test
    void leaveEntitiesOfOtherTypesAndTheirValues() {
        startOf("ngsi-v2");
        task.put(List.of(record("x", entity("x", "a", 1), 10)));
        broker.requests.clear();

        task.put(List.of(deletion("Other", "x", 20), record("x", entity("x", "a", 2), 15), deletion("Other", "y", 20)));

        assertThat(broker.requests).hasSize(2);
        assertThat(broker.requests.get(0).body().path("entities"))
                .hasToString("[{\"id\":\"x\",\"type\":\"Other\"},{\"id\":\"y\",\"type\":\"Other\"}]");
        assertThat(broker.value("x", "a").asInt()).isEqualTo(2);
        task.put(List.of(deletion("Other", "x", 30)));
        assertThat(broker.requests.get(2).path()).endsWith("/v2/entities/x?type=Other");
        task.put(List.of(deletion("T", "x", 30)));
        assertThat(broker.entities).isEmpty();
    }

    /** The id that is no URI becomes one with the type. */
    @ParameterizedTest
    @ValueSource(ints = {1, 3})
    void findTheEntityOfNgsiLdByItsType(int count) {
        startOf("ngsi-ld");
        List<String> ids = IntStream.range(0, count).mapToObj(i -> "probe-" + i).toList();
        task.put(ids.stream().map(id -> record(id, entity(id, "a", 1), 10)).toList());
        assertThat(broker.entities).hasSize(count).containsKey("urn:ngsi-ld:T:probe-0");

        task.put(ids.stream().map(id -> deletion("T", id, 20)).toList());

        assertThat(broker.entities).isEmpty();
    }

    /** The id is unique in NGSI-LD if it is a URI, so that the request to delete names no type. */
    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void leaveTheEntityOfNgsiLdThatHasAnotherType(boolean isCached) {
        startOf("ngsi-ld");
        task.put(List.of(record("urn:x:1", entity("urn:x:1", "a", 1), 30)));
        if (!isCached) {
            restart();
        }
        broker.requests.clear();

        task.put(List.of(deletion("Other", "urn:x:1", 40)));

        assertThat(broker.entities).containsKey("urn:x:1");
        assertThat(broker.requests).isEmpty();
        task.put(List.of(deletion("T", "urn:x:1", 40)));
        assertThat(broker.entities).isEmpty();
    }

    private static SinkRecord deletion(String type, String id, long time) {
        SinkRecord deletion = deletion(id, time);
        deletion.headers().addString("entity-type", type);
        return deletion;
    }

    private void startOf(String api) {
        start("api", api, "parallel.requests", "1", "delete.on.null", "true");
    }

    private static List<SinkRecord> entities() {
        return records(10L, true);
    }

    private static List<SinkRecord> deletions() {
        return records(20L, false);
    }

    private static List<SinkRecord> records(long time, boolean withValue) {
        return IntStream.range(0, MANY)
                .mapToObj(i -> "urn:x:" + i)
                .map(id -> record(id, withValue ? entity(id, "x", 1) : null, time))
                .toList();
    }
}
