package io.furrow.analytics.collision;

import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.EntityReader;
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Takes the positions out of reported entities, at the time of their record. Unreadable records become dead letters, counted
 * as {@code rejected}. Everything else that is no position is counted: {@code skipped} (a deletion, a result, an entity
 * without one), {@code positions.faulty} (one that cannot be right).
 */
final class ReadPositions extends ProcessFunction<TopicRecord, PositionFix> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "collision";
    /** The results of Furrow itself, which come back through the context broker. */
    private static final String OWN_TYPES = "Analytics:";

    private static final Set<String> ATTRIBUTES = Set.of("Mission", "carriedBy", "refRobot", "speed", "heading");

    private transient EntityReader entity;
    private transient Counter rejected;
    private transient Counter skipped;
    private transient Counter faulty;

    @Override
    public void open(OpenContext context) {
        entity = new EntityReader(ATTRIBUTES);
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        rejected = metrics.counter("rejected");
        skipped = metrics.counter("skipped");
        faulty = metrics.counter("positions.faulty");
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<PositionFix> out) {
        if (record.value() == null) {
            skipped.inc();
            return;
        }
        try {
            entity.read(record.value());
            if (entity.type().startsWith(OWN_TYPES)) {
                skipped.inc();
            } else {
                located(record, out);
            }
        } catch (UnreadableException e) {
            rejected.inc();
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
        }
    }

    private void located(TopicRecord record, Collector<PositionFix> out) {
        PositionReading reading = entity.position();
        if (reading instanceof PositionReading.Located located) {
            out.collect(fix(located.position(), record));
        } else if (reading instanceof PositionReading.Faulty) {
            faulty.inc();
        } else {
            skipped.inc();
        }
    }

    private PositionFix fix(Position position, TopicRecord record) {
        FiwareScope scope = FiwareScope.of(
                record.headers().get(HeaderNames.SERVICE), record.headers().get(HeaderNames.SERVICE_PATH));
        String carrier =
                entity.text("carriedBy").or(() -> entity.text("refRobot")).orElse("");
        return new PositionFix(
                record.topic(),
                scope.identity(entity.id()),
                entity.id(),
                entity.type(),
                entity.text("Mission").orElse(""),
                carrier.isEmpty() ? "" : scope.identity(carrier),
                position.latitude(),
                position.longitude(),
                within(entity.number("speed"), Double.MAX_VALUE),
                within(entity.number("heading"), 360),
                record.timestamp());
    }

    private static double within(double number, double greatest) {
        return number >= 0 && number <= greatest ? number : Double.NaN;
    }
}
