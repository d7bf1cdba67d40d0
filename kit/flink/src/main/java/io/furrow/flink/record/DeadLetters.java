package io.furrow.flink.record;

import org.apache.flink.util.OutputTag;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * What an operator sets aside: the original key and bytes on {@code <topic>.dead}, the reason in the headers; of a large record
 * the beginning, and where all of it is.
 */
public final class DeadLetters {
    /** The side output of every operator that can meet bad input. */
    public static final OutputTag<TopicRecord> TAG = new OutputTag<>("dead-letters") {
        private static final long serialVersionUID = 1L;
    };

    private DeadLetters() {}

    /**
     * Whether a job that reads what {@code ingest} reads leaves this record's dead letter to it: both refuse the same, and one
     * letter says it.
     */
    public static boolean areOfIngest(TopicRecord record) {
        return record.topic().equals(Topics.RAW);
    }

    /**
     * A letter has the time of its record, but one from the future that of now, and its record's in {@link DeadLetter#TIME}: a
     * topic need not take it otherwise.
     *
     * @param stage who set it aside, for instance {@code ingest}
     */
    public static TopicRecord of(TopicRecord record, UnreadableException why, String stage) {
        DeadLetter letter = new DeadLetter(why.reason(), why.getMessage(), stage, record.position());
        TopicRecord dead =
                LargeRecords.beginning(record).to(Topics.dead(record.topic())).with(letter.headers());
        return why.reason() == Reason.FROM_THE_FUTURE
                ? dead.at(System.currentTimeMillis()).with(DeadLetter.TIME, Long.toString(record.timestamp()))
                : dead;
    }
}
