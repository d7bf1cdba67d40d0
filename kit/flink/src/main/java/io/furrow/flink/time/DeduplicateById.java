package io.furrow.flink.time;

import java.io.Serializable;
import java.time.Duration;
import java.util.Iterator;
import java.util.Map;
import java.util.function.Function;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.MapState;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.job.PerMissionMetrics;

/**
 * Deduplicates events by id within a time after the first one; keyed by entity, so that their order is preserved.
 *
 * <p>State: ids seen and their expiry, per entity. Cleared: by event-time timers, a tenth of the time apart. Late: an event behind the
 * watermark, of this run or an earlier one, is stored from that watermark on. Emits: first appearances, in order; the rest are counted as
 * {@code repeated}.
 */
public final class DeduplicateById<T> extends KeyedProcessFunction<String, T, T> implements LatenessAware {
    private static final long serialVersionUID = 1L;
    private static final int TIMERS_PER_WINDOW = 10;

    /** Extracts an event's id; serialized with the job. */
    public interface IdOf<T> extends Function<T, String>, Serializable {}

    /** Extracts the domain or mission for which a duplicate counts; serialized with the job. */
    public interface NameOf<T> extends Function<T, String>, Serializable {}

    private final IdOf<T> idOf;
    private final NameOf<T> domainOf;
    private final NameOf<T> missionOf;
    private final long windowMillis;
    private transient MapState<String, Long> forgetAt;
    private transient Counter repeated;
    private transient PerMissionMetrics<Counter> repeatedPerMission;
    private transient EventTimeProgress reached;

    public DeduplicateById(Duration window, IdOf<T> idOf) {
        this(window, idOf, null, null);
    }

    /** Also counts duplicates per domain and mission. */
    public DeduplicateById(Duration window, IdOf<T> idOf, NameOf<T> domainOf, NameOf<T> missionOf) {
        this.idOf = idOf;
        this.windowMillis = window.toMillis();
        this.domainOf = domainOf;
        this.missionOf = missionOf;
    }

    @Override
    public void judgeBy(EventTimeProgress reached) {
        this.reached = reached;
    }

    @Override
    public void open(OpenContext context) {
        forgetAt = getRuntimeContext().getMapState(new MapStateDescriptor<>("forget-at", Types.STRING, Types.LONG));
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        repeated = metrics.counter("repeated");
        repeatedPerMission =
                new PerMissionMetrics<>(metrics, PerMissionMetrics.USUAL_LIMIT, group -> group.counter("repeated"));
    }

    @Override
    public void processElement(T event, Context context, Collector<T> out) throws Exception {
        String id = idOf.apply(event);
        if (forgetAt.contains(id)) {
            count(event);
            return;
        }
        long from = Math.max(context.timestamp(), reached.of(context.getCurrentKey()));
        long step = Math.max(1, windowMillis / TIMERS_PER_WINDOW);
        long until = Math.floorDiv(from + windowMillis, step) * step + step;
        forgetAt.put(id, until);
        context.timerService().registerEventTimeTimer(until);
        out.collect(event);
    }

    private void count(T event) {
        repeated.inc();
        if (domainOf != null) {
            repeatedPerMission.of(domainOf.apply(event), missionOf.apply(event)).inc();
        }
    }

    @Override
    public void onTimer(long timestamp, OnTimerContext context, Collector<T> out) throws Exception {
        for (Iterator<Map.Entry<String, Long>> ids = forgetAt.iterator(); ids.hasNext(); ) {
            if (ids.next().getValue() <= timestamp) {
                ids.remove();
            }
        }
        if (forgetAt.isEmpty()) {
            forgetAt.clear(); // the heap backend would retain an empty map per entity
        }
    }
}
