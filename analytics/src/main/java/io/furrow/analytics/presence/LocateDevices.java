package io.furrow.analytics.presence;

import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.AheadLimit;
import io.furrow.flink.DeadLetters;
import io.furrow.flink.Epochs;
import io.furrow.flink.ReplayKind;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.EntityReader;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Takes the positions out of reported entities, at the event time of their record. Unreadable records and those from the future, counted as {@code
 * rejected}, become dead letters, but those of {@code data.raw}, which {@code ingest} sets aside. Everything else that is no position is
 * counted: {@code skipped} (a deletion, a result, an entity without one), {@code positions.faulty} (one that cannot be right).
 */
final class LocateDevices extends ProcessFunction<TopicRecord, PresenceFix> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "presence";
    /** The results of Furrow itself, which come back through the context broker. */
    private static final String OWN_TYPES = "Analytics:";

    private static final String MISSION = "Mission";

    private final AheadLimit ahead;
    private transient EntityReader entity;
    private transient Counter rejected;
    private transient Counter skipped;
    private transient Counter faulty;

    LocateDevices(AheadLimit ahead) {
        this.ahead = ahead;
    }

    @Override
    public void open(OpenContext context) {
        entity = new EntityReader(Set.of(MISSION));
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        rejected = metrics.counter("rejected");
        skipped = metrics.counter("skipped");
        faulty = metrics.counter("positions.faulty");
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<PresenceFix> out) {
        if (record.value() == null) {
            skipped.inc();
            return;
        }
        try {
            ahead.check(record);
            Epochs.timeOf(record); // refuses what tells none, an end too
            boolean isEnd = ReplayKind.of(record) == ReplayKind.END;
            if (!isEnd) {
                entity.read(record.value());
            }
            if (isEnd || entity.type().startsWith(OWN_TYPES)) {
                skipped.inc();
            } else {
                locate(record, out);
            }
        } catch (UnreadableException e) {
            rejected.inc();
            if (!DeadLetters.areOfIngest(record)) {
                context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
            }
        }
    }

    private void locate(TopicRecord record, Collector<PresenceFix> out) throws UnreadableException {
        PositionReading reading = entity.position();
        if (reading instanceof PositionReading.Located located) {
            FiwareScope scope = FiwareScope.of(
                    record.headers().get(HeaderNames.SERVICE), record.headers().get(HeaderNames.SERVICE_PATH));
            out.collect(new PresenceFix(
                    record.topic(),
                    scope.identity(entity.id()),
                    entity.id(),
                    entity.text(MISSION).orElse(""),
                    located.position().latitude(),
                    located.position().longitude(),
                    Epochs.timeOf(record)));
        } else if (reading instanceof PositionReading.Faulty) {
            faulty.inc();
        } else {
            skipped.inc();
        }
    }
}
