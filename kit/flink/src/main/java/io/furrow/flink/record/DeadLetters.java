package io.furrow.flink.record;

import org.apache.flink.util.OutputTag;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Creates an operator's dead letters: the original key and bytes on {@code <topic>.dead}, the reason in the headers; of a large
 * record the beginning, and its position.
 */
public final class DeadLetters {
    /** The side output of every operator that can receive invalid input. */
    public static final OutputTag<TopicRecord> TAG = new OutputTag<>("dead-letters") {
        private static final long serialVersionUID = 1L;
    };

    private DeadLetters() {}

    /**
     * Whether a job leaves this record's dead letter to {@code ingest}, which reads the same input and rejects the same
     * records, so that there is one letter.
     */
    public static boolean areOfIngest(TopicRecord record) {
        return record.topic().equals(Topics.RAW);
    }

    /**
     * A letter has the time of its record; for a record from the future the current time, with its record's in
     * {@link DeadLetter#TIME}, because a topic may reject it otherwise.
     *
     * @param stage that rejected the record, for instance {@code ingest}
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
