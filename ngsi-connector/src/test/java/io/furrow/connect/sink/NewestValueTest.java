package io.furrow.connect.sink;

import java.util.List;
import java.util.stream.IntStream;

import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.connect.sink.FakeContextBroker.Reply;
import io.furrow.connect.sink.FakeContextBroker.Update;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** What is newer by event time stays, whatever comes when. */
class NewestValueTest extends SinkFixture {
    @BeforeEach
    void startTask() {
        start("delete.on.null", "true");
    }

    @Test
    void keepsBothOfTwoPartialUpdatesInOneDelivery() {
        task.put(List.of(record("a", "x", 1, 10), record("a", "y", 2, 5)));

        assertThat(broker.requests).hasSize(1);
        assertThat(broker.value("a", "x").intValue()).isEqualTo(1);
        assertThat(broker.value("a", "y").intValue()).isEqualTo(2);
    }

    @Test
    void writesNothingThatIsOlderThanWhatAnEarlierDeliveryWrote() {
        task.put(List.of(record("a", "x", 2, 20)));
        task.put(List.of(record("a", "x", 1, 10)));

        assertThat(broker.requests).hasSize(1);
        assertThat(broker.value("a", "x").intValue()).isEqualTo(2);
    }

    @Test
    void writesWhatIsAsOldAgainBecauseItMayBeACorrection() {
        task.put(List.of(record("a", "x", 2, 20)));
        task.put(List.of(record("a", "x", 3, 20)));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(3);
    }

    @Test
    void readsTheTimesOfAnEntityOnceAfterAStart() {
        task.put(List.of(record("a", "x", 2, 20)));
        restart();
        task.put(List.of(record("a", "x", 1, 10), record("a", "y", 1, 10)));
        task.put(List.of(record("a", "x", 0, 15)));

        assertThat(broker.queries).hasValue(2);
        assertThat(broker.value("a", "x").intValue()).isEqualTo(2);
        assertThat(broker.value("a", "y").intValue()).isEqualTo(1);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "ngsi-v2 | 404 | ''",
                "ngsi-ld | 404 | ''",
                "ngsi-v2 | 404 | {\"error\": \"NotFound\"}",
                "ngsi-v2 | 404 | {\"error\": {\"code\": \"NOT_FOUND\"}}",
                "ngsi-v2 | 400 | <html>400 The SSL certificate error</html>",
                "ngsi-ld | 407 | ''"
            })
    void readsThemAgainWhenAProxyAnsweredForTheContextBroker(String api, int status, String answer) {
        restart("api", api);
        task.put(List.of(record("urn:x:a", "x", 2, 20)));
        restart();
        broker.toQueries = new Reply(status, answer);
        assertThatThrownBy(() -> task.put(List.of(record("urn:x:a", "x", 1, 10))))
                .isInstanceOf(RetriableException.class);
        broker.toQueries = null;
        task.put(List.of(record("urn:x:a", "x", 1, 10)));

        assertThat(broker.value("urn:x:a", "x").intValue()).isEqualTo(2);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "ngsi-v2 | {\"error\": \"NonExistingTenant\"}",
                "ngsi-ld | {\"type\": \"https://uri.etsi.org/ngsi-ld/errors/NonexistentTenant\"}"
            })
    void writesTheFirstEntityOfATenant(String api, String answer) {
        restart("api", api);
        broker.toQueries = new Reply(404, answer);
        task.put(List.of(record("urn:x:a", "x", 2, 20)));

        assertThat(broker.value("urn:x:a", "x").intValue()).isEqualTo(2);
    }

    @Test
    void readsThemAgainWhenItsPartitionsAreNew() {
        task.put(List.of(record("a", "x", 1, 10)));
        broker.entities.put(
                "a",
                json("{'id':'a','type':'T','x':{'value':3,'type':'Integer','metadata':{"
                        + "'TimeInstant':{'type':'DateTime','value':'1970-01-01T00:00:00.030Z'}}}}"));
        task.open(List.of(new TopicPartition("t", 0)));
        task.put(List.of(record("a", "x", 2, 20)));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(3);
    }

    /** Time of the entity 50; the attribute changed with it or before, or after it at 70. */
    @ParameterizedTest
    @CsvSource({"60, 60, 51, true", "60, 60, 49, false", "70, 60, 61, false", "70, 60, 71, true"})
    void takesWhatOthersWroteForAsOldAsTheEntitySaysUnlessItWasChangedSince(
            int modified, int reported, int time, boolean written) {
        broker.entities.put(
                "a",
                json(("{'id':'a','type':'T','Time':{'type':'Integer','value':50,'metadata':{'dateModified':"
                                + "{'type':'DateTime','value':'1970-01-01T00:00:00.0%dZ'}}},'x':{'type':'Integer','value':1,"
                                + "'metadata':{'dateModified':{'type':'DateTime','value':'1970-01-01T00:00:00.0%dZ'}}}}")
                        .formatted(reported, modified)));

        task.put(List.of(record("a", "x", 2, time)));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(written ? 2 : 1);
    }

    @Test
    void deletesTheEntityOfARecordWithoutValueAndDoesNotBringItBackForOlderData() {
        task.put(List.of(record("urn:x:a", "x", 1, 10)));
        task.put(List.of(deletion("urn:x:a", 20)));
        task.put(List.of(record("urn:x:a", "x", 2, 15)));
        assertThat(broker.entities).isEmpty();
        assertThat(broker.requests)
                .extracting(Update::method, Update::path)
                .last()
                .hasToString("(\"DELETE\", \"/v2/entities/urn%3Ax%3Aa\")");

        task.put(List.of(record("urn:x:a", "y", 3, 30)));
        assertThat(broker.entities.get("urn:x:a").has("x")).isFalse();
        assertThat(broker.value("urn:x:a", "y").intValue()).isEqualTo(3);
    }

    @Test
    void takesAnAbsentEntityForDeleted() {
        task.put(List.of(deletion("a", 20)));

        assertThat(context.reported).isEmpty();
        assertThat(broker.requests).extracting(Update::method).containsExactly("DELETE");
    }

    @Test
    void leavesWhatIsNewerThanADeletion() {
        task.put(List.of(record("a", "x", 1, 10), record("a", "y", 2, 30)));
        task.put(List.of(deletion("a", 20)));

        assertThat(broker.requests)
                .extracting(Update::path)
                .containsExactly("/v2/op/update", "/v2/entities/a/attrs/x?type=T");
    }

    @Test
    void leavesOutWhatCameFromAContextBrokerUnlessToldOtherwise() {
        SinkRecord echo = record("a", "x", 1, 10);
        echo.headers().addString("ce_source", "/ngsi/51c0ac9ed714fb3b37d7d5a8");
        SinkRecord news = record("b", "x", 1, 10);
        news.headers().addString("ce_source", "/furrow/temperature");

        task.put(List.of(echo, news));
        assertThat(broker.entities).containsOnlyKeys("b");

        restart("echo.sources", "");
        task.put(List.of(echo));
        assertThat(broker.entities).containsOnlyKeys("a", "b");
    }

    @Test
    void takesTheStatedTimeWhereTheTopicStampsRecordsItself() {
        SinkRecord late =
                new SinkRecord("t", 0, null, "a", null, entity("a", "x", 1), 0, 99_000L, TimestampType.LOG_APPEND_TIME);
        late.headers().addString("ce_time", "1970-01-01T00:00:00.010Z");
        task.put(List.of(record("a", "x", 2, 20)));
        task.put(List.of(late));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(2);
    }

    @Test
    void isolatesOneOfManyInFewRequests() {
        restart("batch.size", "1024");
        poison("\"e77\"", 400, "no");
        List<SinkRecord> records = IntStream.range(0, 1024)
                .mapToObj(i -> record("e" + i, "x", i, i))
                .toList();

        task.put(records);

        assertThat(broker.entities).hasSize(1023).doesNotContainKey("e77");
        assertThat(broker.requests).hasSize(21);
        assertThat(context.reported).singleElement().satisfies(reported -> {
            assertThat(reported.record().key()).isEqualTo("e77");
            assertThat(reported.cause()).hasMessageContainingAll("400", "no");
        });
    }

    @Test
    void triesTheRecordsOfARefusedUpdateOneByOne() {
        poison("\"bad\"", 400, "no");

        task.put(List.of(record("a", "x", 1, 10), record("a", "bad", 2, 20), record("a", "x", 0, 5)));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(1);
        assertThat(context.reported)
                .singleElement()
                .satisfies(reported -> assertThat(reported.record().timestamp()).isEqualTo(20));
    }

    @Test
    void countsEveryRecordOnceOverJmx() throws Exception {
        SinkRecord echo = record("a", "x", 1, 10);
        echo.headers().addString("ce_source", "/ngsi/1");
        SinkRecord unreadable = record("a", "no json", 1);
        poison("\"bad\"", 400, "no");
        task.put(
                List.of(record("a", "x", 1, 10), record("a", "y", 1, 10), record("b", "bad", 1, 10), echo, unreadable));
        task.put(List.of(record("a", "x", 0, 5), deletion("c", 5)));

        assertThat(counted("received")).isEqualTo(7);
        assertThat(List.of(
                        counted("written"),
                        counted("coalesced"),
                        counted("stale"),
                        counted("deleted"),
                        counted("refused"),
                        counted("unreadable"),
                        counted("echo")))
                .containsOnly(1L);
    }

    private static long counted(String name) throws javax.management.JMException {
        return (Long) java.lang.management.ManagementFactory.getPlatformMBeanServer()
                .getAttribute(
                        new javax.management.ObjectName("furrow.connect:type=ngsi-sink,connector=ngsi-sink,task=0"),
                        name + "-total");
    }

    @Test
    void keepsEntitiesOfOneIdAndTwoTypesApart() {
        task.put(List.of(
                record("a", "x", 1, 10),
                record("a", Entity.builder("a", "Other").integer("x", 2).build().toBytes(), 5)));

        assertThat(broker.requests)
                .singleElement()
                .satisfies(update -> assertThat(update.size()).isEqualTo(2));
    }

    private static com.fasterxml.jackson.databind.JsonNode json(String quoted) {
        return Unchecked.get(() -> NgsiJson.mapper().readTree(quoted.replace('\'', '"')));
    }
}
