package io.furrow.ingest.latest;

import java.time.Duration;
import java.time.Instant;
import java.util.Map;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

/**
 * Merges what is reported of an entity into the newest that is known of it; keyed by identity.
 *
 * <p>State: the newest value of each attribute and its event time, per entity. Cleared: by its deletion, of which the time
 * alone is kept until no repeat is to be expected. Late: changes only attributes of which nothing newer is known, else
 * nothing, counted as {@code outdated}. Emits: the whole entity after each event that changed it; no value after its deletion.
 */
public final class MergeLatest extends KeyedProcessFunction<String, ReportedEvent, TopicRecord> {
    private static final long serialVersionUID = 1L;

    private final long deletionKeptMillis;
    private final LatestKey key;
    private transient ValueState<KnownEntity> entity;
    private transient Counter outdated;

    /** @param deletionKept how long after a deletion, in event time, older events may still come */
    public MergeLatest(Duration deletionKept, LatestKey key) {
        this.deletionKeptMillis = deletionKept.toMillis();
        this.key = key;
    }

    @Override
    public void open(OpenContext context) {
        entity = getRuntimeContext()
                .getState(new ValueStateDescriptor<>("entity", TypeInformation.of(KnownEntity.class)));
        outdated = getRuntimeContext().getMetricGroup().counter("outdated");
    }

    @Override
    public void processElement(ReportedEvent event, Context context, Collector<TopicRecord> out) throws Exception {
        KnownEntity known = entity.value() == null ? KnownEntity.NEVER_SEEN : entity.value();
        KnownEntity merged = event.isDeletion()
                ? known.withoutAnything(event.time())
                : known.with(Entity.parse(event.record().value()), event.time());
        if (merged == known) {
            outdated.inc();
            return;
        }
        entity.update(merged);
        if (merged.deleted()) {
            context.timerService().registerEventTimeTimer(merged.time() + deletionKeptMillis);
        }
        out.collect(latest(event, merged));
    }

    /** Of an event that came late the record has the time of the newest, so that time never steps back. */
    private TopicRecord latest(ReportedEvent event, KnownEntity merged) {
        TopicRecord record = TopicRecord.of(
                Topics.LATEST,
                merged.time(),
                key.of(event),
                merged.deleted() ? null : merged.toBytes(event.entityId()),
                event.record().headers());
        return merged.time() == event.time()
                ? record
                : record.with(Map.of(
                        HeaderNames.CE_TIME, Instant.ofEpochMilli(merged.time()).toString(),
                        HeaderNames.TS_DEVICE, Long.toString(merged.time())));
    }

    @Override
    public void onTimer(long timestamp, OnTimerContext context, Collector<TopicRecord> out) throws Exception {
        KnownEntity known = entity.value();
        if (known != null && known.deleted() && known.time() + deletionKeptMillis <= timestamp) {
            entity.clear();
        }
    }
}
