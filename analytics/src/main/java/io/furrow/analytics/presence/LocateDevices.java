package io.furrow.analytics.presence;

import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Takes the positions out of reported entities, at the time of their record. Unreadable records become dead letters, counted as
 * {@code rejected}. Everything else that is no position is counted: {@code skipped} (a deletion, a result, an entity without one),
 * {@code positions.faulty} (one that cannot be right).
 */
final class LocateDevices extends ProcessFunction<TopicRecord, PresenceFix> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "presence";
    /** The results of Furrow itself, which come back through the context broker. */
    private static final String OWN_TYPES = "Analytics:";

    private static final Set<String> WANTED = Stream.concat(PositionReading.ATTRIBUTES.stream(), Stream.of("Mission"))
            .collect(Collectors.toUnmodifiableSet());

    private transient Counter rejected;
    private transient Counter skipped;
    private transient Counter faulty;

    @Override
    public void open(OpenContext context) {
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
            Entity entity = Entity.parse(record.value(), WANTED);
            if (entity.type().startsWith(OWN_TYPES)) {
                skipped.inc();
            } else {
                locate(entity, record, out);
            }
        } catch (UnreadableException e) {
            rejected.inc();
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
        }
    }

    private void locate(Entity entity, TopicRecord record, Collector<PresenceFix> out) {
        PositionReading reading = PositionReading.of(entity);
        if (reading instanceof PositionReading.Located located) {
            FiwareScope scope = FiwareScope.of(
                    record.headers().get(HeaderNames.SERVICE), record.headers().get(HeaderNames.SERVICE_PATH));
            out.collect(new PresenceFix(
                    record.topic(),
                    scope.identity(entity.id()),
                    entity.id(),
                    entity.text("Mission").orElse(""),
                    located.position().latitude(),
                    located.position().longitude(),
                    record.timestamp()));
        } else if (reading instanceof PositionReading.Faulty) {
            faulty.inc();
        } else {
            skipped.inc();
        }
    }
}
