package io.furrow.flink.record;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Event time of a replay that seeks back, loops or restarts: each start begins an epoch, and each epoch has {@link #SPAN} of
 * event time to itself, so that event time never goes back:
 *
 * <pre>event time = epoch × SPAN + original time</pre>
 *
 * <p>State that is open when an epoch begins ends as without further records, and no record of the new epoch is late. Times
 * are compared by event time; lookups of fields and devices, and reported times, use the {@link #original} time. In epoch 0,
 * that of all live topics, both are the same.
 */
public final class Epochs {
    /** Milliseconds, 557 years; a power of two, so that no division is needed. */
    public static final long SPAN = 1L << 44;

    /** The greatest epoch: one every ten seconds for a month. */
    public static final long LAST = (1L << 18) - 1;

    private Epochs() {}

    /** The epoch of an event time. */
    public static long of(long time) {
        return time < SPAN ? 0 : time / SPAN;
    }

    /** The original time, epoch ms. */
    public static long original(long time) {
        return time < SPAN ? time : time % SPAN;
    }

    /** The event time of the original time 0 in the epoch of an event time. */
    public static long begin(long time) {
        return time - original(time);
    }

    /** The last instant of an epoch. */
    public static long end(long epoch) {
        return (epoch + 1) * SPAN - 1;
    }

    /** Whether the epoch of an event time is over at a watermark. */
    static boolean isOver(long time, long watermark) {
        return watermark >= end(of(time));
    }

    /** An event time as part of an id: the original time, and the epoch unless it is the first. */
    public static String text(long time) {
        return time < SPAN ? Long.toString(time) : original(time) + ":" + of(time);
    }

    /**
     * The event time of a record; a replay's without a header is of epoch 0, or of the time of its timestamp.
     *
     * @throws UnreadableException if the record is a replay's and a header is not a valid epoch or offset
     */
    public static long timeOf(TopicRecord record) throws UnreadableException {
        if (!Topics.isReplay(record.topic())) {
            return record.timestamp();
        }
        long epoch = number(record, HeaderNames.REPLAY_EPOCH, LAST);
        return epoch * SPAN + originalTimeOf(record);
    }

    /** The original time of a record, epoch ms; exceptions as {@link #timeOf}. */
    public static long originalTimeOf(TopicRecord record) throws UnreadableException {
        if (!Topics.isReplay(record.topic())) {
            return record.timestamp();
        }
        long original = record.timestamp() - number(record, HeaderNames.REPLAY_OFFSET, Long.MAX_VALUE);
        if (original < 0 || original >= SPAN) {
            throw new UnreadableException(
                    Reason.NOT_AN_EVENT,
                    "the timestamp %d less %s is not between 0 and %d"
                            .formatted(record.timestamp(), HeaderNames.REPLAY_OFFSET, SPAN));
        }
        return original;
    }

    private static long number(TopicRecord record, String header, long greatest) throws UnreadableException {
        String text = record.headers().get(header);
        if (text == null) {
            return 0;
        }
        try {
            long number = Long.parseLong(text);
            if (number >= 0 && number <= greatest) {
                return number;
            }
        } catch (NumberFormatException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, header + " is not a number", e);
        }
        throw new UnreadableException(Reason.NOT_AN_EVENT, "%s is not between 0 and %d".formatted(header, greatest));
    }
}
