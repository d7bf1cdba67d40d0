package io.furrow.flink;

import org.apache.flink.util.OutputTag;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** What an operator sets aside: the original key and bytes on {@code <topic>.dead}, the reason in the headers. */
public final class DeadLetters {
    /** The side output of every operator that can meet bad input. */
    public static final OutputTag<TopicRecord> TAG = new OutputTag<>("dead-letters") {
        private static final long serialVersionUID = 1L;
    };

    private DeadLetters() {}

    /**
     * @param stage who set it aside, for instance {@code ingest}
     */
    public static TopicRecord of(TopicRecord record, UnreadableException why, String stage) {
        DeadLetter letter = new DeadLetter(why.reason(), why.getMessage(), stage, record.position());
        return record.to(Topics.dead(record.topic())).with(letter.headers());
    }
}
