package io.furrow.flink.time;

import java.time.Duration;
import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatNoException;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Skew 10 s, limit 1 h; the wall clock stands at 1,000,000 s. */
class ClockSkewLimitTest {
    private static final long NOW = 1_000_000_000;
    private static final long HOUR = 3_600_000;
    private static final ClockSkewLimit LIMIT =
            new ClockSkewLimit(new ReceiptTime(Duration.ofSeconds(10)), Duration.ofHours(1));

    @Test
    void refusesWhatIsFurtherAheadOfItsReceipt() {
        accepts(record(NOW + HOUR, null));
        assertThatThrownBy(() -> LIMIT.check(record(NOW + HOUR + 1, null), NOW))
                .isInstanceOfSatisfying(
                        UnreadableException.class, e -> assertThat(e.reason()).isEqualTo(Reason.FROM_THE_FUTURE))
                .hasMessageContainingAll("1970-01-12T14:46:40.001Z", "--max-ahead PT1H");
        refuses(record(NOW - HOUR, Long.toString(NOW - 2 * HOUR - 1)));
        accepts(record(NOW - HOUR, Long.toString(NOW - 2 * HOUR)));
        refuses(record(NOW + HOUR + 10_001, Long.toString(Long.MAX_VALUE)));
        accepts(record(NOW + HOUR + 10_000, Long.toString(Long.MAX_VALUE)));
        refuses(record(Long.MAX_VALUE, "no number"));
    }

    @Test
    void takesReplaysAtTheirWord() {
        TopicRecord replayed = record(Long.MAX_VALUE, null).with(HeaderNames.ORIGIN, "replay");
        refuses(replayed);
        accepts(replayed.to("data.hoeing.replay.0a1b2c3d"));
        accepts(record(NOW, Long.toString(NOW - 2 * HOUR)).to("data.hoeing.replay.0a1b2c3d"));
    }

    @Test
    void isWrittenWithATimeThatTopicsTake() {
        TopicRecord record = record(Long.MAX_VALUE, null);
        UnreadableException why = new UnreadableException(Reason.FROM_THE_FUTURE, "why");
        long before = System.currentTimeMillis();

        TopicRecord letter = DeadLetters.of(record, why, "ingest");

        assertThat(letter.timestamp()).isBetween(before, System.currentTimeMillis());
        assertThat(letter.headers())
                .containsEntry("dead-reason", "from-the-future")
                .containsEntry("dead-time", Long.toString(Long.MAX_VALUE));
        assertThat(DeadLetters.of(record, new UnreadableException(Reason.NOT_JSON, "why"), "ingest")
                        .timestamp())
                .isEqualTo(Long.MAX_VALUE);
    }

    private static void accepts(TopicRecord record) {
        assertThatNoException().isThrownBy(() -> LIMIT.check(record, NOW));
    }

    private static void refuses(TopicRecord record) {
        assertThatThrownBy(() -> LIMIT.check(record, NOW)).isInstanceOf(UnreadableException.class);
    }

    private static TopicRecord record(long timestamp, String received) {
        TopicRecord record = TopicRecord.of("data.raw", timestamp, "r", new byte[0], Map.of());
        return received == null ? record : record.with(HeaderNames.TS_SOURCE, received);
    }
}
