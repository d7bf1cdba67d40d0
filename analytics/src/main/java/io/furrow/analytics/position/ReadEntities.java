package io.furrow.analytics.position;

import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.ReplayKind;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.result.ResultTypes;

/**
 * Base of functions that extract values from reported entities, at the event time of their record. Unreadable records and those
 * from the future, counted as {@code rejected}, become dead letters, except those of {@code data.raw}, for which {@code ingest}
 * writes them. Records without a value for this job are counted as {@code skipped}: deletions, results, marks of a replay, and
 * what the subclass skips.
 *
 * @param <T> the extracted values
 */
public abstract class ReadEntities<T> extends ProcessFunction<TopicRecord, T> {
    private static final long serialVersionUID = 1L;

    private final String stage;
    private final Set<ReplayKind> kinds;
    private final Set<String> attributes;
    private final ClockSkewLimit ahead;
    private transient EntityReader entity;
    private transient Counter rejected;
    private transient Counter skipped;

    /**
     * @param stage name of the job in dead letters
     * @param kinds kinds of records that are read
     * @param attributes attributes that are extracted, beside those of the position
     */
    protected ReadEntities(String stage, Set<ReplayKind> kinds, Set<String> attributes, ClockSkewLimit ahead) {
        this.stage = stage;
        this.kinds = kinds;
        this.attributes = attributes;
        this.ahead = ahead;
    }

    /**
     * Extracts from the parsed entity.
     *
     * @return whether the entity has a value for this job
     * @throws UnreadableException if the record is to become a dead letter
     */
    protected abstract boolean extract(EntityReader entity, TopicRecord record, Collector<T> out)
            throws UnreadableException;

    protected final Counter counter(String name) {
        return getRuntimeContext().getMetricGroup().counter(name);
    }

    @Override
    public void open(OpenContext context) {
        entity = new EntityReader(attributes);
        rejected = counter("rejected");
        skipped = counter("skipped");
    }

    @Override
    public final void processElement(TopicRecord record, Context context, Collector<T> out) {
        try {
            if (record.value() == null || !read(record, out)) {
                skipped.inc();
            }
        } catch (UnreadableException e) {
            rejected.inc();
            if (!DeadLetters.areOfIngest(record)) {
                context.output(DeadLetters.TAG, DeadLetters.of(record, e, stage));
            }
        }
    }

    private boolean read(TopicRecord record, Collector<T> out) throws UnreadableException {
        ahead.check(record);
        Epochs.timeOf(record); // rejects records without a readable time, also at the end of a replay
        if (!kinds.contains(ReplayKind.of(record))) {
            return false;
        }
        entity.read(record.value());
        return !ResultTypes.isResult(entity.type()) && extract(entity, record, out);
    }
}
