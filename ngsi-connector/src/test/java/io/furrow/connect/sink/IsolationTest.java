package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.sink.SinkRecord;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.connect.sink.FakeContextBroker.Reply;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** One entity that makes the context broker answer 500 stops no other, and a context broker that is broken refuses none. */
class IsolationTest extends SinkFixture {
    @BeforeEach
    void setTries() {
        options.putAll(Map.of("delete.on.null", "true", "retry.isolate.after", "3", "retry.refuse.after", "6"));
    }

    @Test
    void setsTheOneEntityOfAHundredAsideAndWritesTheOthers() {
        start();
        poison("\"e77\"", 500, "out of order");
        List<SinkRecord> records = records(0, 100);

        putAgainAndAgain(records, 2);
        task.put(records);

        assertThat(broker.entities).hasSize(99).doesNotContainKey("e77");
        assertThat(context.reported).singleElement().satisfies(reported -> {
            assertThat(reported.record().key()).isEqualTo("e77");
            assertThat(reported.cause()).hasMessageContaining("500 out of order");
        });
    }

    @Test
    void knowsAnEntityAgainThatDrewA500() {
        start();
        poison("\"e7\"", 500, "out of order");
        List<SinkRecord> first = records(0, 10);
        putAgainAndAgain(first, 2);
        task.put(first);

        task.put(records(0, 20));

        assertThat(broker.entities).hasSize(19);
        assertThat(context.reported)
                .extracting(reported -> reported.record().key())
                .containsExactly("e7", "e7");
    }

    @Test
    void triesTheRecordsOfThatEntityOneByOne() {
        start();
        poison("\"bad\"", 500, "out of order");
        List<SinkRecord> records = List.of(record("a", "bad", 1, 1), record("a", "x", 2, 2));

        putAgainAndAgain(records, 2);
        task.put(records);

        assertThat(broker.value("a", "x").intValue()).isEqualTo(2);
        assertThat(context.reported)
                .singleElement()
                .satisfies(reported -> assertThat(reported.record().timestamp()).isEqualTo(1));
    }

    @Test
    void refusesNothingWhileTheContextBrokerAnswersEverythingSo() {
        start("retry.refuse.after", "0");
        poison("", 500, "out of order");
        List<SinkRecord> records = records(0, 10);

        putAgainAndAgain(records, 20);
        broker.behaviour = update -> Reply.WRITTEN;
        task.put(records);

        assertThat(broker.entities).hasSize(10);
        assertThat(context.reported).isEmpty();
    }

    @Test
    void takesADeletionOfWhatIsAbsentForNoProofThatTheContextBrokerWorks() {
        start("retry.refuse.after", "0");
        poison("append", 500, "out of order");
        List<SinkRecord> records = new ArrayList<>(records(0, 3));
        records.add(deletion("gone", 1_000));

        putAgainAndAgain(records, 10);
    }

    @Test
    void refusesAnEntityThatIsAloneAfterSoManyTries() {
        start();
        poison("", 500, "out of order");
        List<SinkRecord> records = records(0, 1);

        putAgainAndAgain(records, 5);
        task.put(records);

        assertThat(context.reported).hasSize(1);
    }

    @Test
    void takesNothingApartForAContextBrokerThatIsOverloaded() {
        start();
        poison("\"e7\"", 503, "out of order");

        putAgainAndAgain(records(0, 10), 10);

        assertThat(broker.requests)
                .allSatisfy(request -> assertThat(request.size()).isEqualTo(10));
        assertThat(context.reported).isEmpty();
    }

    @Test
    void neverTakesApartWhenToldSo() {
        start("retry.isolate.after", "0");
        poison("\"e7\"", 500, "out of order");

        putAgainAndAgain(records(0, 10), 10);

        assertThat(context.reported).isEmpty();
    }

    @Test
    void setsADeletionAsideThatDrawsA500() {
        start();
        task.put(records(0, 10));
        poison("e7", 500, "out of order");
        List<SinkRecord> deletions =
                IntStream.range(0, 10).mapToObj(i -> deletion("e" + i, 1_000)).toList();

        putAgainAndAgain(deletions, 2);
        task.put(deletions);

        assertThat(broker.entities).containsOnlyKeys("e7");
        assertThat(context.reported)
                .singleElement()
                .satisfies(reported -> assertThat(reported.record().key()).isEqualTo("e7"));
    }

    private void putAgainAndAgain(List<SinkRecord> records, int times) {
        for (int i = 0; i < times; i++) {
            assertThatThrownBy(() -> task.put(records)).as("try %d", i).isInstanceOf(RetriableException.class);
        }
        assertThat(context.reported).isEmpty();
    }

    private static List<SinkRecord> records(int from, int to) {
        return IntStream.range(from, to)
                .mapToObj(i -> record("e" + i, "x", i, i))
                .toList();
    }
}
