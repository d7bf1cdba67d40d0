package io.furrow.dashboard.proxy;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.InitialState;
import io.furrow.dashboard.feed.StateBudget;
import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.feed.StreamLimits;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class SendQueueTest {
    private static final String VALVE = "{\"id\":\"pb-13\",\"type\":\"Valve\"}";
    private static final String PUMP = "{\"id\":\"pb-13\",\"type\":\"Pump\"}";
    private static final StreamLimits LIMITS =
            new StreamLimits(1, 1, 1, Duration.ofSeconds(1), 3, 10_000, 1_000, 1_000, 1, 1_000);

    private static final long STATE = 10;

    private final StateBudget budget = new StateBudget(STATE);

    private static FeedRecord record(String key, String value, long sequence) {
        return new FeedRecord(
                new ConsumerRecord<>(
                        "data.raw", 0, sequence, key == null ? null : key.getBytes(UTF_8), value.getBytes(UTF_8)),
                sequence,
                1_000);
    }

    private static SendQueue queue(StreamRequest.Mode mode, boolean prime, StreamRequest.Format format) {
        return new SendQueue(new StreamRequest("data.raw", mode, prime, format), LIMITS, new StreamCounters());
    }

    @Test
    void preservesTheOrderOfRecords() {
        SendQueue queue = queue(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        queue.offer(record("a", "1", 0));
        queue.offer(record("a", "2", 1));

        assertThat(queue.poll()).isEqualTo("1");
        assertThat(queue.poll()).isEqualTo("2");
        assertThat(queue.poll()).isNull();
    }

    @Test
    void isFullBeyondTheLimitOfRecordsOrBytes() {
        SendQueue queue = queue(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        for (int i = 0; i < 3; i++) {
            assertThat(queue.offer(record("a", "1", i))).isTrue();
        }
        assertThat(queue.offer(record("a", "1", 3))).isFalse();

        SendQueue heavy = queue(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        assertThat(heavy.offer(record("a", "x".repeat(20_000), 0))).isFalse();
    }

    @Test
    void doesNotCountSentRecords() {
        SendQueue queue = queue(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        for (int i = 0; i < 100; i++) {
            assertThat(queue.offer(record("a", "x".repeat(5_000), i))).isTrue();
            queue.poll();
        }
    }

    @Test
    void replacesWaitingRecordsByNewerOnesOfTheSameKey() {
        SendQueue queue = queue(StreamRequest.Mode.LATEST, false, StreamRequest.Format.RECORD);
        for (int i = 0; i < 50; i++) {
            assertThat(queue.offer(record("k" + i % 2, Integer.toString(i), i))).isTrue();
        }

        assertThat(queue.poll())
                .contains("\"value\":48", "\"value\":49", "\"merged\":48")
                .doesNotContain("\"value\":47");
        assertThat(queue.poll()).isNull();
    }

    @Test
    void sendsAllRecordsWithoutAKey() {
        SendQueue queue = queue(StreamRequest.Mode.LATEST, false, StreamRequest.Format.RECORD);
        queue.offer(record(null, "1", 0));
        queue.offer(record(null, "2", 1));

        assertThat(queue.poll()).contains("\"value\":1", "\"value\":2").doesNotContain("merged");
    }

    @Test
    void holdsRecordsBackUntilTheInitialStateIsSent() {
        SendQueue queue = queue(StreamRequest.Mode.ALL, true, StreamRequest.Format.RECORD);
        queue.offer(record("a", "2", 7));
        assertThat(queue.poll()).isNull();

        queue.prime(state(record("a", "1", FeedRecord.NO_SEQUENCE)));

        assertThat(queue.poll()).contains("\"kind\":\"prime\"", "\"value\":1").doesNotContain("sequence");
        assertThat(queue.poll()).isEqualTo("{\"primed\":true}");
        assertThat(queue.poll()).contains("\"kind\":\"event\"", "\"sequence\":7", "\"value\":2");
    }

    @Test
    void releasesTheInitialStateOnceItIsSentOrTheStreamIsClosed() {
        SendQueue sent = queue(StreamRequest.Mode.ALL, true, StreamRequest.Format.VALUE);
        sent.prime(state(record("a", "1", FeedRecord.NO_SEQUENCE), record("b", "2", FeedRecord.NO_SEQUENCE)));
        sent.poll();
        assertThat(budget.used()).isEqualTo(STATE);
        sent.poll();
        assertThat(budget.used()).isZero();
        sent.close();
        assertThat(budget.used()).isZero();

        SendQueue closed = queue(StreamRequest.Mode.ALL, true, StreamRequest.Format.VALUE);
        closed.prime(state(record("a", "1", FeedRecord.NO_SEQUENCE)));
        closed.close();
        assertThat(budget.used()).isZero();

        SendQueue tooLate = queue(StreamRequest.Mode.ALL, true, StreamRequest.Format.VALUE);
        tooLate.close();
        tooLate.prime(state(record("a", "1", FeedRecord.NO_SEQUENCE)));
        assertThat(budget.used()).isZero();

        queue(StreamRequest.Mode.ALL, true, StreamRequest.Format.VALUE).prime(state());
        assertThat(budget.used()).as("empty").isZero();
    }

    private InitialState.State state(FeedRecord... records) {
        StateBudget.Share share = budget.share();
        share.resize(STATE, "data.raw");
        return new InitialState.State(List.of(records), share);
    }

    /** The same id in two tenants, and with two types in one of them. */
    @Test
    void mergesRecordsOfTheSameEntityOnly() {
        SendQueue queue = queue(StreamRequest.Mode.LATEST, false, StreamRequest.Format.VALUE);
        queue.offer(in("farm", VALVE));
        queue.offer(in("farm", PUMP));
        queue.offer(in("other", VALVE));
        queue.offer(in("farm", VALVE));

        assertThat(List.of(queue.poll(), queue.poll(), queue.poll())).containsExactly(VALVE, PUMP, VALVE);
        assertThat(queue.poll()).isNull();
    }

    @Test
    void sendsARecordBehindAnEarlierDeletion() {
        SendQueue queue = queue(StreamRequest.Mode.LATEST, false, StreamRequest.Format.VALUE);
        queue.offer(in("farm", VALVE));
        queue.offer(in("farm", null));
        queue.offer(in("farm", VALVE));

        assertThat(List.of(queue.poll(), queue.poll())).containsExactly("null", VALVE);
        assertThat(queue.poll()).isNull();
    }

    private static FeedRecord in(String tenant, String value) {
        ConsumerRecord<byte[], byte[]> record = new ConsumerRecord<>(
                "data.raw", 0, 0, "pb-13".getBytes(UTF_8), value == null ? null : value.getBytes(UTF_8));
        record.headers().add("fiware-service", tenant.getBytes(UTF_8));
        return new FeedRecord(record, 0, 1_000);
    }
}
