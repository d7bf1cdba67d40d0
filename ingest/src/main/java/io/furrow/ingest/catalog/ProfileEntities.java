package io.furrow.ingest.catalog;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Predicate;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.MapState;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.TimerService;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.time.EndOfEventTime;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Preaggregates the events of each entity, so that a mission with many devices has no key that receives every event.
 *
 * <p>State: per entity the aggregate since the last interval, the entries in which it was counted, and when the oldest of them
 * expires. Cleared: the aggregate at the end of the interval, a counted entry when the entity has had no event in it for the
 * retention, all of it by the entity's deletion. Late: no difference. Emits: the aggregate, once per interval; the entity's
 * removal from an expired entry, before {@link MergeCatalog} removes that.
 */
public final class ProfileEntities extends KeyedProcessFunction<String, ReportedEvent, CatalogEntry> {
    private static final long serialVersionUID = 1L;

    private final long intervalMillis;
    private final long retentionMillis;
    private transient MapState<String, CatalogEntry> pending;
    private transient MapState<String, CatalogEntry> counted;
    private transient ValueState<Long> expiry;

    public ProfileEntities(Duration interval, Duration retention) {
        this.intervalMillis = Math.max(1, interval.toMillis());
        this.retentionMillis = retention.toMillis();
    }

    @Override
    public void open(OpenContext context) {
        TypeInformation<CatalogEntry> entry = TypeInformation.of(CatalogEntry.class);
        pending = getRuntimeContext().getMapState(new MapStateDescriptor<>("pending", Types.STRING, entry));
        counted = getRuntimeContext().getMapState(new MapStateDescriptor<>("counted", Types.STRING, entry));
        expiry = getRuntimeContext().getState(new ValueStateDescriptor<>("expiry", Types.LONG));
    }

    @Override
    public void processElement(ReportedEvent event, Context context, Collector<CatalogEntry> out) throws Exception {
        if (event.isDeletion()) {
            flush(out);
            remove(entry -> event.type().isEmpty() || entry.type().equals(event.type()), out);
            scheduleExpiry(context.timerService());
            return;
        }
        CatalogEntry entry = entry(event);
        String key = entry.key();
        CatalogEntry before = pending.get(key);
        if (before != null) {
            pending.put(key, before.plus(entry)); // so it is counted, and its timer is set
            return;
        }
        if (!counted.contains(key)) {
            counted.put(key, entry.onlyEntities(0));
            entry = entry.andEntities(1);
        }
        if (pending.isEmpty()) {
            long from = Math.max(context.timestamp(), context.timerService().currentWatermark());
            context.timerService().registerEventTimeTimer(nextInterval(from, intervalMillis));
        }
        pending.put(key, entry);
    }

    private static CatalogEntry entry(ReportedEvent event) {
        try {
            return CatalogEntry.of(event);
        } catch (UnreadableException e) {
            throw new IllegalStateException(
                    "only entities come here: " + event.record().position(), e);
        }
    }

    /** The end of the interval that contains a time. */
    static long nextInterval(long time, long interval) {
        return (Math.floorDiv(time, interval) + 1) * interval - 1;
    }

    @Override
    public void onTimer(long timestamp, OnTimerContext context, Collector<CatalogEntry> out) throws Exception {
        flush(out);
        boolean isExpiry = Long.valueOf(timestamp).equals(expiry.value());
        if (isExpiry && !EndOfEventTime.isAt(context.timerService().currentWatermark())) {
            remove(entry -> entry.last() + retentionMillis <= timestamp, out);
        }
        if (isExpiry || expiry.value() == null) {
            scheduleExpiry(context.timerService());
        }
    }

    private void remove(Predicate<CatalogEntry> which, Collector<CatalogEntry> out) throws Exception {
        List<CatalogEntry> ended = new ArrayList<>();
        counted.values().forEach(ended::add);
        ended.removeIf(which.negate());
        for (CatalogEntry entry : ended) {
            out.collect(entry.onlyEntities(-1));
            counted.remove(entry.key());
        }
    }

    /** Sets the only timer for counted entries to when the oldest one expires. */
    private void scheduleExpiry(TimerService timers) throws Exception {
        if (expiry.value() != null) {
            timers.deleteEventTimeTimer(expiry.value());
            expiry.clear();
        }
        long oldest = Long.MAX_VALUE;
        for (CatalogEntry entry : counted.values()) {
            oldest = Math.min(oldest, entry.last());
        }
        if (!counted.isEmpty() && !EndOfEventTime.isAt(timers.currentWatermark())) {
            expiry.update(oldest + retentionMillis);
            timers.registerEventTimeTimer(expiry.value());
        }
    }

    private void flush(Collector<CatalogEntry> out) throws Exception {
        List<CatalogEntry> entries = new ArrayList<>();
        pending.values().forEach(entries::add);
        pending.clear();
        for (CatalogEntry entry : entries) {
            counted.put(entry.key(), entry.onlyEntities(0));
            out.collect(entry);
        }
    }
}
