package io.furrow.dashboard.proxy;

import java.time.Duration;
import java.util.List;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.junit.jupiter.api.Test;

import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.feed.StreamLimits;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class SendQueueTest {
    private static final String VALVE = "{\"id\":\"pb-13\",\"type\":\"Valve\"}";
    private static final String PUMP = "{\"id\":\"pb-13\",\"type\":\"Pump\"}";
    private static final StreamLimits FEW =
            new StreamLimits(1, 1, 1, Duration.ofSeconds(1), 3, 10_000, 1_000, 1_000, 1, 1_000);

    private static FeedRecord record(String key, String value, long sequence) {
        return new FeedRecord(
                new ConsumerRecord<>(
                        "data.raw", 0, sequence, key == null ? null : key.getBytes(UTF_8), value.getBytes(UTF_8)),
                sequence,
                1_000);
    }

    private static SendQueue outbox(StreamRequest.Mode mode, boolean prime, StreamRequest.Format format) {
        return new SendQueue(new StreamRequest("data.raw", mode, prime, format), FEW, new StreamCounters());
    }

    @Test
    void keepsEveryRecordInItsOrder() {
        SendQueue outbox = outbox(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        outbox.offer(record("a", "1", 0));
        outbox.offer(record("a", "2", 1));

        assertThat(outbox.take()).isEqualTo("1");
        assertThat(outbox.take()).isEqualTo("2");
        assertThat(outbox.take()).isNull();
    }

    @Test
    void isOverWhereMoreWaitThanMay() {
        SendQueue outbox = outbox(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        for (int i = 0; i < 3; i++) {
            assertThat(outbox.offer(record("a", "1", i))).isTrue();
        }
        assertThat(outbox.offer(record("a", "1", 3))).isFalse();

        SendQueue heavy = outbox(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        assertThat(heavy.offer(record("a", "x".repeat(20_000), 0))).isFalse();
    }

    @Test
    void countsWhatIsTakenAsWaitingNoMore() {
        SendQueue outbox = outbox(StreamRequest.Mode.ALL, false, StreamRequest.Format.VALUE);
        for (int i = 0; i < 100; i++) {
            assertThat(outbox.offer(record("a", "x".repeat(5_000), i))).isTrue();
            outbox.take();
        }
    }

    @Test
    void letsTheNewestOfAKeyTakeThePlaceOfOlderOnes() {
        SendQueue outbox = outbox(StreamRequest.Mode.LATEST, false, StreamRequest.Format.RECORD);
        for (int i = 0; i < 50; i++) {
            assertThat(outbox.offer(record("k" + i % 2, Integer.toString(i), i)))
                    .isTrue();
        }

        assertThat(outbox.take())
                .contains("\"value\":48", "\"value\":49", "\"merged\":48")
                .doesNotContain("\"value\":47");
        assertThat(outbox.take()).isNull();
    }

    @Test
    void takesRecordsWithoutAKeyForDifferentOnes() {
        SendQueue outbox = outbox(StreamRequest.Mode.LATEST, false, StreamRequest.Format.RECORD);
        outbox.offer(record(null, "1", 0));
        outbox.offer(record(null, "2", 1));

        assertThat(outbox.take()).contains("\"value\":1", "\"value\":2").doesNotContain("merged");
    }

    @Test
    void holdsRecordsBackUntilWhatWasKnownIsSent() {
        SendQueue outbox = outbox(StreamRequest.Mode.ALL, true, StreamRequest.Format.RECORD);
        outbox.offer(record("a", "2", 7));
        assertThat(outbox.take()).isNull();

        outbox.prime(List.of(record("a", "1", FeedRecord.NO_SEQUENCE)));

        assertThat(outbox.take()).contains("\"kind\":\"prime\"", "\"value\":1").doesNotContain("sequence");
        assertThat(outbox.take()).isEqualTo("{\"primed\":true}");
        assertThat(outbox.take()).contains("\"kind\":\"event\"", "\"sequence\":7", "\"value\":2");
    }

    /** One id in two tenants, and with two types in one of them. */
    @Test
    void mergesTheReportsOfAnEntityAlone() {
        SendQueue outbox = outbox(StreamRequest.Mode.LATEST, false, StreamRequest.Format.VALUE);
        outbox.offer(in("farm", VALVE));
        outbox.offer(in("farm", PUMP));
        outbox.offer(in("other", VALVE));
        outbox.offer(in("farm", VALVE));

        assertThat(List.of(outbox.take(), outbox.take(), outbox.take())).containsExactly(VALVE, PUMP, VALVE);
        assertThat(outbox.take()).isNull();
    }

    @Test
    void sendsWhatCameAfterADeletionBehindIt() {
        SendQueue outbox = outbox(StreamRequest.Mode.LATEST, false, StreamRequest.Format.VALUE);
        outbox.offer(in("farm", VALVE));
        outbox.offer(in("farm", null));
        outbox.offer(in("farm", VALVE));

        assertThat(List.of(outbox.take(), outbox.take())).containsExactly("null", VALVE);
        assertThat(outbox.take()).isNull();
    }

    private static FeedRecord in(String tenant, String value) {
        ConsumerRecord<byte[], byte[]> record = new ConsumerRecord<>(
                "data.raw", 0, 0, "pb-13".getBytes(UTF_8), value == null ? null : value.getBytes(UTF_8));
        record.headers().add("fiware-service", tenant.getBytes(UTF_8));
        return new FeedRecord(record, 0, 1_000);
    }
}
