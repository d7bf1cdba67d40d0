package io.furrow.flink.record;

import java.io.Serializable;
import java.time.Duration;
import java.util.OptionalLong;

import io.furrow.flink.job.JobOptions;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/**
 * The time at which a record was received, epoch ms: the source's stamp, {@code ts-source}, but no later than the wall clock
 * and the skew; the wall clock without a stamp. Records on the topic of a replay have no receipt: they may be of any time. A
 * plausible stamp does not depend on the wall clock, so the same input gives the same receipts.
 *
 * @param skew how far the source's clock may be ahead
 */
public record ReceiptTime(Duration skew) implements Serializable {
    /** The receipt of replayed records. */
    public static final long NONE = Long.MAX_VALUE;

    /** With the skew of a job's options. */
    public static ReceiptTime of(JobOptions options) {
        return new ReceiptTime(options.clocks().clockSkew());
    }

    /**
     * {@link #NONE} for records that are replayed and later than they were received.
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
        } catch (NumberFormatException e) { // another producer's header
            return now;
        }
    }

    /**
     * The source's stamp, if there is a plausible one and the record is not a replay's.
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
        } catch (NumberFormatException e) { // another producer's header
            return OptionalLong.empty();
        }
    }

    private static boolean isReplayed(TopicRecord record) {
        return Topics.isReplay(record.topic());
    }
}
