package io.furrow.analytics.field;

import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.UnreadableException;

/** Forwards the records of {@code service.fields} that are versions of fields; the others become dead letters. */
public final class ParseFields extends ProcessFunction<TopicRecord, TopicRecord> {
    private static final long serialVersionUID = 1L;

    private final String stage;

    /** @param stage name of the job in dead letters */
    public ParseFields(String stage) {
        this.stage = stage;
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<TopicRecord> out) {
        try {
            FieldVersionChange.read(record);
            out.collect(record);
        } catch (UnreadableException e) {
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, stage));
        }
    }
}
