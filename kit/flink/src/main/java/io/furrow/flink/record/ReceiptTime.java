package io.furrow.flink.record;

import java.io.Serializable;
import java.time.Duration;
import java.util.OptionalLong;

import io.furrow.flink.job.JobOptions;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/**
 * When a record was received, epoch ms: what its source stamped, {@code ts-source}, but no later than the wall clock and the
 * skew; the wall clock if there is no stamp. What is replayed, on the topic of a replay, has none: it may be of any time.
 * A stamp that can be right does not depend on the wall clock, so the same input gives the same receipts.
 *
 * @param skew how far the source's clock may be ahead
 */
public record ReceiptTime(Duration skew) implements Serializable {
    /** Of what is replayed. */
    public static final long NONE = Long.MAX_VALUE;

    /** As a job's options say. */
    public static ReceiptTime of(JobOptions options) {
        return new ReceiptTime(options.clocks().clockSkew());
    }

    /**
     * {@link #NONE} of what is replayed and later than it was received.
     *
     * @param time its event time, epoch ms
     * @param now the wall clock, epoch ms
     */
    public long of(TopicRecord record, long time, long now) {
        long received = received(record, now);
        return time > received && isReplayed(record) ? NONE : received;
    }

    private long received(TopicRecord record, long now) {
        String text = record.headers().get(HeaderNames.TS_SOURCE);
        if (text == null) {
            return now;
        }
        try {
            return Math.min(Long.parseLong(text), now + skew.toMillis());
        } catch (NumberFormatException e) { // a stranger's header
            return now;
        }
    }

    /**
     * What the source stamped, where it did and can be right, and the record is not a replay's.
     *
     * @param now the wall clock, epoch ms
     */
    public OptionalLong stamp(TopicRecord record, long now) {
        String text = record.headers().get(HeaderNames.TS_SOURCE);
        if (text == null || isReplayed(record)) {
            return OptionalLong.empty();
        }
        try {
            long stamp = Long.parseLong(text);
            return stamp > now + skew.toMillis() ? OptionalLong.empty() : OptionalLong.of(stamp);
        } catch (NumberFormatException e) { // a stranger's header
            return OptionalLong.empty();
        }
    }

    private static boolean isReplayed(TopicRecord record) {
        return Topics.isReplay(record.topic());
    }
}
