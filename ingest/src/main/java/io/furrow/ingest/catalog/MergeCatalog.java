package io.furrow.ingest.catalog;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.streaming.api.functions.KeyedProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.EndOfEventTime;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/**
 * Merges the entities of a mission and type into an entry of the catalog.
 *
 * <p>State: the entry, whether it is to be written and has new events, when its last entity was deleted and when it expires, per tenant, domain,
 * mission and type. Cleared: when no event has arrived for the retention. Late: no difference; a deletion after the entry has
 * expired is ignored. Emits: the entry for {@code data.catalog}, at most once per interval of event time; when it expires a
 * tombstone.
 */
public final class MergeCatalog extends KeyedProcessFunction<String, CatalogEntry, TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final String TYPE = "furrow.catalog.entry";

    private final long intervalMillis;
    private final long retentionMillis;
    private transient ValueState<CatalogEntry> whole;
    private transient ValueState<Boolean> unwritten;
    private transient ValueState<Long> deleted;
    private transient ValueState<Long> expiry;

    public MergeCatalog(Duration interval, Duration retention) {
        this.intervalMillis = Math.max(1, interval.toMillis());
        this.retentionMillis = retention.toMillis();
    }

    @Override
    public void open(OpenContext context) {
        whole = getRuntimeContext()
                .getState(new ValueStateDescriptor<>("entry", TypeInformation.of(CatalogEntry.class)));
        unwritten = getRuntimeContext().getState(new ValueStateDescriptor<>("unwritten", Types.BOOLEAN));
        deleted = getRuntimeContext().getState(new ValueStateDescriptor<>("deleted", Types.LONG));
        expiry = getRuntimeContext().getState(new ValueStateDescriptor<>("expiry", Types.LONG));
    }

    @Override
    public void processElement(CatalogEntry more, Context context, Collector<TopicRecord> out) throws Exception {
        CatalogEntry before = whole.value();
        if (before == null && more.events() == 0) {
            return;
        }
        CatalogEntry sum = before == null ? more : before.plus(more);
        whole.update(sum);
        if (more.events() > 0) {
            deleted.clear();
        } else if (sum.entities() <= 0) {
            deleted.update(context.timestamp() == null ? more.last() : context.timestamp());
        }
        boolean isWritten = unwritten.value() == null;
        unwritten.update(more.events() > 0 || Boolean.TRUE.equals(unwritten.value()));
        if (isWritten) {
            long from = Math.max(more.last(), context.timerService().currentWatermark());
            context.timerService().registerEventTimeTimer(ProfileEntities.nextInterval(from, intervalMillis));
        }
    }

    @Override
    public void onTimer(long timestamp, OnTimerContext context, Collector<TopicRecord> out) throws Exception {
        CatalogEntry entry = whole.value();
        boolean hasEvents = Boolean.TRUE.equals(unwritten.value());
        if (Long.valueOf(timestamp).equals(expiry.value())
                && !hasEvents
                && !EndOfEventTime.isAt(context.timerService().currentWatermark())) {
            out.collect(record(entry, timestamp, null));
            whole.clear();
            unwritten.clear();
            deleted.clear();
            expiry.clear();
        } else if (unwritten.value() != null) {
            unwritten.clear();
            out.collect(record(entry, entry.last(), entry.toBytes(deleted.value())));
            if (hasEvents || expiry.value() == null) {
                postpone(timestamp, context);
            }
        }
    }

    private void postpone(long timestamp, OnTimerContext context) throws Exception {
        Long before = expiry.value();
        if (before != null) {
            context.timerService().deleteEventTimeTimer(before);
        }
        long until = timestamp + retentionMillis;
        expiry.update(until);
        context.timerService().registerEventTimeTimer(until);
    }

    private static TopicRecord record(CatalogEntry entry, long time, byte[] value) {
        Map<String, String> headers = new HashMap<>();
        headers.put(HeaderNames.CE_TYPE, TYPE);
        headers.put(HeaderNames.SERVICE, entry.service());
        return TopicRecord.of(Topics.CATALOG, time, entry.key(), value, headers);
    }
}
