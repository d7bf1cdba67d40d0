package io.furrow.ingest.latest;

import java.io.IOException;
import java.time.Duration;
import java.time.Instant;
import java.util.Map;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Merges what is reported of an entity into the newest that is known of it; keyed by identity.
 *
 * <p>State: the newest value of each attribute and its event time, per entity. Cleared: by its deletion, of which the time
 * alone is kept for as long as older events may still come. Late: changes only attributes of which nothing newer is known, else
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

    /** Whether anything is known of the current key's entity. */
    boolean knows() throws IOException {
        return entity.value() != null;
    }

    /**
     * Begins with what was known of the current key's entity before the job: which attribute is of which time it does not say, so
     * that all count as of the newest. What is from the future counts as of long ago, or nothing that is reported would count any more.
     *
     * @param newest the latest time that is believed, epoch ms
     * @throws UnreadableException if its value is no entity
     */
    void begin(TopicRecord latest, long newest, TimerService timers) throws IOException, UnreadableException {
        long time = latest.timestamp() <= newest ? latest.timestamp() : 0;
        KnownEntity before = entity.value();
        if (before != null && before.time() > time) {
            return; // brought to the topic once more
        }
        KnownEntity known = latest.value() == null
                ? KnownEntity.NEVER_SEEN.withoutAnything(time)
                : KnownEntity.NEVER_SEEN.with(Entity.parse(latest.value()), time, time);
        remember(known, timers);
    }

    private void remember(KnownEntity known, TimerService timers) throws IOException {
        entity.update(known);
        if (known.deleted()) {
            timers.registerEventTimeTimer(known.time() + deletionKeptMillis);
        }
    }

    @Override
    public void processElement(ReportedEvent event, Context context, Collector<TopicRecord> out) throws Exception {
        KnownEntity known = entity.value() == null ? KnownEntity.NEVER_SEEN : entity.value();
        KnownEntity merged = event.isDeletion()
                ? known.withoutAnything(event.time())
                : known.with(Entity.parse(event.record().value()), event.time(), event.received());
        if (merged == known) {
            outdated.inc();
            return;
        }
        remember(merged, context.timerService());
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
        if (known == null || !known.deleted()) {
            return;
        }
        long until = known.time() + deletionKeptMillis;
        if (until <= timestamp) {
            entity.clear();
        } else { // set when a deletion was remembered for less long
            context.timerService().registerEventTimeTimer(until);
        }
    }
}
