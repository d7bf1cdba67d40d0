package io.furrow.flink.time;

import java.io.Serializable;
import java.time.Duration;
import java.time.Instant;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Rejects records from the future: those whose event time is after their {@link ReceiptTime} by more than the limit. Such a record
 * would supersede all that arrive until then, and would be buffered for as long.
 *
 * @param max how far ahead a record may be
 */
public record ClockSkewLimit(ReceiptTime receiptTime, Duration max) implements Serializable {
    /** With a job's options. */
    public static ClockSkewLimit of(JobOptions options) {
        return new ClockSkewLimit(ReceiptTime.of(options), options.clocks().maxAhead());
    }

    /** @throws UnreadableException {@link Reason#FROM_THE_FUTURE} */
    public void check(TopicRecord record) throws UnreadableException {
        check(record, System.currentTimeMillis());
    }

    /** @param now the wall clock, epoch ms */
    void check(TopicRecord record, long now) throws UnreadableException {
        long received = receiptTime.of(record, record.timestamp(), now);
        if (received != ReceiptTime.NONE && record.timestamp() - max.toMillis() > received) {
            throw new UnreadableException(
                    Reason.FROM_THE_FUTURE,
                    "the event time %s is after the receipt, %s, by more than --max-ahead %s; set the clock of what made it"
                            .formatted(Instant.ofEpochMilli(record.timestamp()), Instant.ofEpochMilli(received), max));
        }
    }
}
