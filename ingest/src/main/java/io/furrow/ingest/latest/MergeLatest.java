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
 * Merges what is reported of an entity into the newest that is known of it; keyed by identity, and in it by type.
 *
 * <p>State: the newest value of each attribute and its event time, per entity. Cleared: by its deletion, of which the time
 * alone is kept for as long as older events may still come. Late: changes only attributes of which nothing newer is known, else
 * nothing, counted as {@code outdated}. Emits: the whole entity after each event that changed it; no value after its deletion. The first entity of an id has the id as its key; one of
 * another type has its type behind that, and in a header, so that compaction keeps both.
 */
public final class MergeLatest extends KeyedProcessFunction<String, ReportedEvent, TopicRecord> {
    private static final ByType.Descriptor<LatestEntity> ENTITY =
            new ByType.Descriptor<>("entity", LatestEntity.class, LatestEntity::type);

    private static final long serialVersionUID = 1L;

    private final long deletionKeptMillis;
    private final LatestKey key;
    private transient ByType<LatestEntity> entities;
    private transient Counter outdated;

    /** @param deletionKept how long after a deletion, in event time, older events may still come */
    public MergeLatest(Duration deletionKept, LatestKey key) {
        this.deletionKeptMillis = deletionKept.toMillis();
        this.key = key;
    }

    @Override
    public void open(OpenContext context) {
        entities = ENTITY.of(getRuntimeContext());
        outdated = getRuntimeContext().getMetricGroup().counter("outdated");
    }

    /** Whether anything is known of an entity of the current key's id. */
    boolean knows() throws Exception {
        return !entities.isEmpty();
    }

    /**
     * Begins with what was known of the current key's entity before the job: which attribute is of which time it does not say, so
     * that all count as of the newest. What is from the future counts as of long ago, or nothing that is reported would count any more.
     *
     * @param newest the latest time that is believed, epoch ms
     * @throws io.furrow.model.ngsi.UnreadableException if its value is not an entity
     */
    void begin(TopicRecord latest, long newest, TimerService timers) throws Exception {
        long time = latest.timestamp() <= newest ? latest.timestamp() : 0;
        String other = LatestKey.otherTypeOf(latest);
        LatestEntity before = other.isEmpty() ? entities.first() : entities.get(other);
        if (before != null && before.time() > time) {
            return; // brought to the topic once more
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

    /** Of an event that came late the record has the time of the newest, so that time never steps back. */
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
            } else { // of another entity, or set when a deletion was remembered for less long
                await(known, context.timerService());
            }
        }
    }
}
