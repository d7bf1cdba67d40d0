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

import io.furrow.flink.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/**
 * Adds the entities of a mission and type up to an entry of the catalogue.
 *
 * <p>State: the entry, and whether it is to be written, per tenant, domain, mission and type. Cleared: the mark by its timer;
 * the entry never, it is what the catalogue is: as many as there are missions and types. Late: no difference. Emits: the entry
 * for {@code data.catalog}, at most once per interval of event time.
 */
public final class MergeCatalog extends KeyedProcessFunction<String, CatalogEntry, TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final String TYPE = "furrow.catalog.entry";

    private final long intervalMillis;
    private transient ValueState<CatalogEntry> whole;
    private transient ValueState<Boolean> unwritten;

    public MergeCatalog(Duration interval) {
        this.intervalMillis = Math.max(1, interval.toMillis());
    }

    @Override
    public void open(OpenContext context) {
        whole = getRuntimeContext()
                .getState(new ValueStateDescriptor<>("entry", TypeInformation.of(CatalogEntry.class)));
        unwritten = getRuntimeContext().getState(new ValueStateDescriptor<>("unwritten", Types.BOOLEAN));
    }

    @Override
    public void processElement(CatalogEntry more, Context context, Collector<TopicRecord> out) throws Exception {
        CatalogEntry before = whole.value();
        whole.update(before == null ? more : before.plus(more));
        if (unwritten.value() == null) {
            unwritten.update(true);
            long from = Math.max(more.last(), context.timerService().currentWatermark());
            context.timerService().registerEventTimeTimer(ProfileEntities.nextInterval(from, intervalMillis));
        }
    }

    @Override
    public void onTimer(long timestamp, OnTimerContext context, Collector<TopicRecord> out) throws Exception {
        unwritten.clear();
        CatalogEntry entry = whole.value();
        Map<String, String> headers = new HashMap<>();
        headers.put(HeaderNames.CE_TYPE, TYPE);
        headers.put(HeaderNames.SERVICE, entry.service());
        out.collect(TopicRecord.of(Topics.CATALOG, entry.last(), entry.key(), entry.toBytes(), headers));
    }
}
