package io.furrow.connect.sink;

import java.util.List;
import java.util.Map;

import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.sink.FakeContextBroker.Reply;
import io.furrow.connect.sink.FakeContextBroker.Update;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.groups.Tuple.tuple;

class NgsiSinkTaskTest extends SinkFixture {
    private long offset;

    @BeforeEach
    void startTask() {
        start(
                "context.broker.url", broker.url() + "/",
                "fiware.service", "farm",
                "fiware.servicepath", "/root",
                "retry.backoff.ms", "50",
                "retry.backoff.max.ms", "300");
    }

    @Test
    void writesADeliveryAsOneAppendPerScope() {
        SinkRecord other = record("b", entity("b", "x", 1));
        other.headers().addString("fiware-service", "agri").addString("fiware-servicepath", "/plot1");

        task.put(List.of(record("a", entity("a", "x", 1)), other, record("a", entity("a", "x", 2))));

        assertThat(broker.requests)
                .extracting(Update::path, Update::service, Update::servicePath, Update::size)
                .containsExactlyInAnyOrder(
                        tuple("/v2/op/update", "farm", "/root", 1), tuple("/v2/op/update", "agri", "/plot1", 1));
        assertThat(broker.requests.stream()
                        .filter(update -> update.service().equals("farm"))
                        .findFirst()
                        .orElseThrow()
                        .body())
                .hasToString("""
                        {"actionType":"append","entities":[{"id":"a","type":"T",\
                        "x":{"type":"Integer","value":2,"metadata":{"TimeInstant":{"type":"DateTime",\
                        "value":"1970-01-01T00:00:01.002Z"}}}}]}""");
    }

    @Test
    void readsBytesTextAndSchemalessJson() {
        Object map = Map.of("id", "c", "type", "T", "x", Map.of("type", "Number", "value", 3L, "metadata", Map.of()));

        task.put(List.of(
                record("a", entity("a", "x", 1)), record("b", new String(entity("b", "x", 1))), record("c", map)));

        assertThat(broker.entities).containsOnlyKeys("a", "b", "c");
    }

    @Test
    void writesNumbersDigitForDigitAndNulls() {
        task.put(List.of(record("a", "{\"type\": \"T\", \"x\": 21.50, \"y\": 9007199254740993, \"z\": null}")));

        assertThat(broker.value("a", "x")).hasToString("21.50");
        assertThat(broker.value("a", "y")).hasToString("9007199254740993");
        assertThat(broker.value("a", "z").isNull()).isTrue();
    }

    @Test
    void reportsWhatCannotBeReadAndWritesTheRest() {
        SinkRecord badScope = record("c", entity("c", "x", 1));
        badScope.headers().addString("fiware-service", "a\nb");

        task.put(
                List.of(record("a", "no json".getBytes()), record("b", entity("b", "x", 1)), badScope, record("d", 5)));

        assertThat(broker.entities).containsOnlyKeys("b");
        assertThat(context.reported)
                .extracting(reported -> reported.record().key())
                .containsExactly("a", "c", "d");
    }

    @Test
    void leavesDeletionsOutUnlessToldOtherwise() {
        task.put(List.of(record("a", entity("a", "x", 1))));
        task.put(List.of(record("a", null), record("b", entity("b", "x", 1))));

        assertThat(broker.entities).containsOnlyKeys("a", "b");
        assertThat(context.reported).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(ints = {500, 503, 429, 408})
    void asksForTheSameRecordsAgainWhenTheContextBrokerIsAway(int status) {
        broker.behaviour = update -> new Reply(status, "later");

        assertThatThrownBy(() -> task.put(List.of(record("x", "no json".getBytes()), record("a", entity("a", "x", 1)))))
                .isInstanceOf(RetriableException.class)
                .hasMessageContaining(status + " later");
        assertThat(context.timeouts).containsExactly(50L);
        assertThat(context.reported).as("it will come again, once is enough").isEmpty();
    }

    @Test
    void waitsTwiceAsLongAfterEachFailureAndAsLongAsTheBrokerAsksFor() {
        List<SinkRecord> records = List.of(record("a", entity("a", "x", 1)));
        broker.behaviour = update -> new Reply(429, "", broker.requests.size() == 3 ? "7" : null);
        for (int i = 0; i < 5; i++) {
            assertThatThrownBy(() -> task.put(records)).isInstanceOf(RetriableException.class);
        }
        broker.behaviour = update -> Reply.WRITTEN;
        task.put(records);
        broker.behaviour = update -> new Reply(503, "");
        assertThatThrownBy(() -> task.put(records)).isInstanceOf(RetriableException.class);

        assertThat(context.timeouts).containsExactly(50L, 100L, 7_000L, 300L, 300L, 50L);
    }

    @Test
    void readsKeyValuesAndTakesTheIdOfTheKeyWhereThereIsNone() {
        task.put(List.of(record("a", "{\"type\": \"T\", \"x\": 5}")));

        assertThat(broker.value("a", "x").intValue()).isEqualTo(5);
        assertThat(broker.entities.get("a").path("x").path("type").textValue()).isEqualTo("Number");
    }

    @Test
    void asksForTheSameRecordsAgainWhenNobodyListens() {
        broker.close();

        assertThatThrownBy(() -> task.put(List.of(record("a", entity("a", "x", 1)))))
                .isInstanceOf(RetriableException.class)
                .hasMessageContaining(broker.url().getAuthority().substring(0, 10));
    }

    @Test
    void failsWhereNoReporterIsSetNamingTheRecordAndTheWordsOfTheBroker() {
        NgsiSinkTask strict = startWith(new FakeSinkContext(false));
        broker.behaviour = update -> new Reply(422, "too odd");

        assertThatThrownBy(() -> strict.put(List.of(record("a", entity("a", "x", 1)))))
                .isInstanceOf(ConnectException.class)
                .isNotInstanceOf(RetriableException.class)
                .hasMessageContainingAll("results-0@0", "422 too odd");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "301 | ''",
                "401 | ''",
                "404 | ''",
                "404 | <html>nginx</html>",
                "200 | <html>log in</html>",
                "400 | <html><head><title>400 The SSL certificate error</title></head></html>",
                "407 | ''",
                "407 | <html>log in</html>",
                "451 | ''",
                "451 | <html>not here</html>"
            })
    void triesAgainWhereAProxyAnswersForTheContextBroker(int status, String page) {
        broker.behaviour = update -> new Reply(status, page);
        List<SinkRecord> delivery = List.of(record("a", entity("a", "x", 1)));

        for (int i = 0; i < 3; i++) {
            assertThatThrownBy(() -> task.put(delivery))
                    .isInstanceOf(RetriableException.class)
                    .hasMessageContaining("context.broker.url");
        }
        broker.behaviour = update -> Reply.WRITTEN;
        task.put(delivery);

        assertThat(broker.value("a", "x").asInt()).isEqualTo(1);
        assertThat(context.reported).isEmpty();
    }

    @Test
    void keepsAnInterruptSet() {
        Thread.currentThread().interrupt();

        assertThatThrownBy(() -> task.put(List.of(record("a", entity("a", "x", 1)))))
                .isInstanceOf(RetriableException.class);
        assertThat(Thread.interrupted()).isTrue();
    }

    private SinkRecord record(String key, Object value) {
        long time = 1_000 + offset;
        return new SinkRecord("results", 0, null, key, null, value, offset++, time, TimestampType.CREATE_TIME);
    }
}
