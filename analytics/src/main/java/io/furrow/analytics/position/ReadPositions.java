package io.furrow.analytics.position;

import java.util.EnumSet;
import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.ReplayKind;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

/** Extracts positions. Impossible ones are counted as {@code positionsFaulty}; entities without one are skipped. */
public final class ReadPositions extends ReadEntities<PositionFix> {
    private static final long serialVersionUID = 1L;

    private transient Counter faulty;

    /** @param stage name of the job in dead letters */
    public ReadPositions(String stage, ClockSkewLimit ahead) {
        super(
                stage,
                EnumSet.of(ReplayKind.EVENT, ReplayKind.PRIME),
                Set.of("Mission", "carriedBy", "refRobot", "speed", "heading"),
                ahead);
    }

    @Override
    public void open(OpenContext context) {
        super.open(context);
        faulty = counter("positionsFaulty");
    }

    @Override
    protected boolean extract(EntityReader entity, TopicRecord record, Collector<PositionFix> out)
            throws UnreadableException {
        PositionReading reading = PositionReading.of(record.headers(), entity::position);
        if (reading instanceof PositionReading.Located located) {
            out.collect(fix(entity, located.position(), record));
            return true;
        }
        if (reading instanceof PositionReading.Faulty) {
            faulty.inc();
            return true;
        }
        return false;
    }

    private static PositionFix fix(EntityReader entity, Position position, TopicRecord record)
            throws UnreadableException {
        FiwareScope scope = FiwareScope.of(record.headers());
        String carrier =
                entity.text("carriedBy").or(() -> entity.text("refRobot")).orElse("");
        return new PositionFix(
                record.topic(),
                scope.identity(entity.type(), entity.id()),
                entity.id(),
                entity.type(),
                entity.name("Mission").orElse(""),
                carrier.isEmpty() ? "" : scope.identity(carrier),
                position.latitude(),
                position.longitude(),
                within(entity.number("speed", Quantity.SPEED), Double.MAX_VALUE),
                within(entity.number("heading", Quantity.HEADING), 360),
                Epochs.timeOf(record));
    }

    private static double within(double number, double greatest) {
        return number >= 0 && number <= greatest ? number : Double.NaN;
    }
}
