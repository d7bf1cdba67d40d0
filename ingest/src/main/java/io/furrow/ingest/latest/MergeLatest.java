package io.furrow.ingest.latest;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.ByType;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.EventEntity;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.SlicedEntity;
import io.furrow.model.topic.Topics;

import static io.furrow.ingest.latest.LatestEntity.NEVER_SEEN;

/**
 * Merges reports of an entity into its newest state; keyed by identity, and within it by type.
 *
 * <p>State: the newest value of each attribute and its event time, per entity. Cleared: by its deletion, of which only the time is retained
 * for as long as older events may still arrive. Late: changes only attributes without a newer value; otherwise ignored, counted as
 * {@code outdated}. Emits: the whole entity after each event that changed it; a tombstone after its deletion. The first entity of an id has
 * the id as its key; one of another type has its type after that, and in a header, so that compaction retains both.
 */
public final class MergeLatest extends KeyedProcessFunction<String, ReportedEvent, TopicRecord> {
    private static final ByType.Descriptor<LatestEntity> ENTITY =
            new ByType.Descriptor<>("entity", LatestEntity.class, LatestEntity::type);

    private static final long serialVersionUID = 1L;

    private final long deletionKeptMillis;
    private final LatestKey key;
    private transient ByType<LatestEntity> entities;
    private transient Counter outdated;

    /** @param deletionKept how long after a deletion, in event time, older events may still arrive */
    public MergeLatest(Duration deletionKept, LatestKey key) {
        this.deletionKeptMillis = deletionKept.toMillis();
        this.key = key;
    }

    @Override
    public void open(OpenContext context) {
        entities = ENTITY.of(getRuntimeContext());
        outdated = getRuntimeContext().getMetricGroup().counter("outdated");
    }

    /** Whether there is state of an entity of the current key's id. */
    boolean knows() throws Exception {
        return !entities.isEmpty();
    }

    /**
     * Initializes the current key's entity from the record before the job: it lacks the times of attributes, so that all count as of the
     * newest. A time in the future counts as long ago, because no report could supersede it otherwise.
     *
     * @param newest the latest plausible time, epoch ms
     * @throws io.furrow.model.ngsi.UnreadableException if its value is not an entity
     */
    void begin(TopicRecord latest, long newest, TimerService timers) throws Exception {
        long time = latest.timestamp() <= newest ? latest.timestamp() : 0;
        String other = LatestKey.otherTypeOf(latest);
        LatestEntity before = other.isEmpty() ? entities.first() : entities.get(other);
        if (before != null && before.time() > time) {
            return; // written to the topic again
        }
        LatestEntity known = latest.value() == null
                ? NEVER_SEEN.withoutAnything(time).ofType(before == null ? other : before.type())
                : NEVER_SEEN.with(SlicedEntity.parse(latest.value()), time, time);
        entities.put(other.isEmpty(), known);
        await(known, timers);
    }

    private void await(LatestEntity known, TimerService timers) {
        if (known.deleted()) {
            timers.registerEventTimeTimer(known.time() + deletionKeptMillis);
        }
    }

    @Override
    public void processElement(ReportedEvent event, Context context, Collector<TopicRecord> out) throws Exception {
        if (event.isDeletion()) {
            List<LatestEntity> ended = entities.allOf(event.type());
            for (LatestEntity known : ended.isEmpty() ? List.of(NEVER_SEEN.ofType(event.type())) : ended) {
                take(event, known, known.withoutAnything(event.time()), context.timerService(), out);
            }
        } else {
            LatestEntity known = entities.get(event.type());
            LatestEntity before = known == null ? NEVER_SEEN : known;
            SlicedEntity reported = EventEntity.of(event.record());
            LatestEntity merged = before.with(reported, event.time(), event.received());
            take(event, before, merged, context.timerService(), out);
        }
    }

    private void take(
            ReportedEvent event,
            LatestEntity known,
            LatestEntity merged,
            TimerService timers,
            Collector<TopicRecord> out)
            throws Exception {
        if (merged == known) {
            outdated.inc();
            return;
        }
        boolean isOther = entities.put(merged.type(), merged);
        await(merged, timers);
        out.collect(latest(event, merged, isOther ? merged.type() : ""));
    }

    /** After a late event the record has the time of the newest, so that time never decreases. */
    private TopicRecord latest(ReportedEvent event, LatestEntity merged, String otherType) {
        TopicRecord latest = TopicRecord.of(
                Topics.LATEST,
                merged.time(),
                key.of(event, otherType),
                merged.deleted() ? null : merged.toBytes(event.entityId()),
                event.record().headers());
        TopicRecord record = otherType.isEmpty() ? latest : latest.with(HeaderNames.ENTITY_TYPE, otherType);
        return merged.time() == event.time()
                ? record
                : record.with(Map.of(
                        HeaderNames.CE_TIME, Instant.ofEpochMilli(merged.time()).toString(),
                        HeaderNames.TS_DEVICE, Long.toString(merged.time())));
    }

    @Override
    public void onTimer(long timestamp, OnTimerContext context, Collector<TopicRecord> out) throws Exception {
        for (LatestEntity known : entities.allOf("")) {
            long until = known.time() + deletionKeptMillis;
            if (known.deleted() && until <= timestamp) {
                entities.remove(known);
            } else { // of another entity, or set with a shorter retention of deletions
                await(known, context.timerService());
            }
        }
    }
}
