package io.furrow.analytics.collision;

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
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Takes the positions out of reported entities, at the event time of their record. Unreadable records and those from the future, counted as {@code
 * rejected}, become dead letters, but those of {@code data.raw}, which {@code ingest} sets aside. Everything else that is no position is
 * counted: {@code skipped} (a deletion, a result, an entity without one), {@code positions.faulty} (one that cannot be right).
 */
final class ReadPositions extends ProcessFunction<TopicRecord, PositionFix> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "collision";
    /** The results of Furrow itself, which come back through the context broker. */
    private static final String OWN_TYPES = "Analytics:";

    private static final Set<String> ATTRIBUTES = Set.of("Mission", "carriedBy", "refRobot", "speed", "heading");

    private final AheadLimit ahead;
    private transient EntityReader entity;
    private transient Counter rejected;
    private transient Counter skipped;
    private transient Counter faulty;

    ReadPositions(AheadLimit ahead) {
        this.ahead = ahead;
    }

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
            ahead.check(record);
            Epochs.timeOf(record); // refuses what tells none, an end too
            boolean isEnd = ReplayKind.of(record) == ReplayKind.END;
            if (!isEnd) {
                entity.read(record.value());
            }
            if (isEnd || entity.type().startsWith(OWN_TYPES)) {
                skipped.inc();
            } else {
                located(record, out);
            }
        } catch (UnreadableException e) {
            rejected.inc();
            if (!DeadLetters.areOfIngest(record)) {
                context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
            }
        }
    }

    private void located(TopicRecord record, Collector<PositionFix> out) throws UnreadableException {
        PositionReading reading = entity.position();
        if (reading instanceof PositionReading.Located located) {
            out.collect(fix(located.position(), record));
        } else if (reading instanceof PositionReading.Faulty) {
            faulty.inc();
        } else {
            skipped.inc();
        }
    }

    private PositionFix fix(Position position, TopicRecord record) throws UnreadableException {
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
                Epochs.timeOf(record));
    }

    private static double within(double number, double greatest) {
        return number >= 0 && number <= greatest ? number : Double.NaN;
    }
}
