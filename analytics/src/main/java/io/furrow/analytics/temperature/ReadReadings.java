package io.furrow.analytics.temperature;

import java.time.Instant;
import java.util.EnumSet;
import java.util.Map;
import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.util.Collector;

import io.furrow.analytics.position.ReadEntities;
import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.LargeRecords;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.flink.time.ReplayKind;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.Quantity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.EntityReader;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

/**
 * Extracts the readings of one attribute. Entities without it are skipped; a value that is not a finite number and an impossible
 * position are counted as {@code faulty}, readings without a position as {@code unlocated}.
 */
final class ReadReadings extends ReadEntities<Reading> {
    private static final long serialVersionUID = 1L;
    /** No temperature is that high; sums and differences of greater doubles could overflow. */
    private static final double MAX = 1e100;

    private final String attribute;
    private transient Counter accepted;
    private transient Counter faulty;
    private transient Counter unlocated;

    ReadReadings(String attribute, ClockSkewLimit ahead) {
        super("temperature", EnumSet.of(ReplayKind.EVENT), Set.of(attribute), ahead);
        this.attribute = attribute;
    }

    @Override
    public void open(OpenContext context) {
        super.open(context);
        accepted = counter("accepted");
        faulty = counter("faulty");
        unlocated = counter("unlocated");
    }

    @Override
    protected boolean extract(EntityReader entity, TopicRecord record, Collector<Reading> out)
            throws UnreadableException {
        if (!entity.has(attribute)) {
            return false;
        }
        double value = entity.number(attribute, Quantity.TEMPERATURE);
        PositionReading place = PositionReading.of(record.headers(), entity::position);
        if (!(Math.abs(value) <= MAX) || place instanceof PositionReading.Faulty) {
            faulty.inc();
        } else if (place instanceof PositionReading.Located located) {
            long time = Epochs.timeOf(record);
            accepted.inc();
            Map<String, String> headers = record.headers();
            FiwareScope scope = FiwareScope.of(headers);
            String eventId = headers.containsKey(HeaderNames.CE_ID)
                    ? idOf(headers.get(HeaderNames.CE_ID), Epochs.of(time))
                    : EventId.of(scope, Entity.parse(record.value()), Instant.ofEpochMilli(time));
            TopicRecord kept =
                    LargeRecords.isLarge(record) ? excerpt(entity, record, located.position(), value) : record;
            out.collect(new Reading(entity.id(), entity.type(), scope, located.position(), value, eventId, kept));
        } else {
            unlocated.inc();
        }
        return true;
    }

    /** The same event in another epoch is not a duplicate. */
    private static String idOf(String event, long epoch) {
        return epoch == 0 ? event : event + ":" + epoch;
    }

    /** The attributes that the job read: an image need not pass through windows only to be late. */
    private TopicRecord excerpt(EntityReader entity, TopicRecord record, Position position, double value) {
        EntityBuilder read = Entity.builder(entity.id(), entity.type())
                .number("Latitude", position.latitude())
                .number("Longitude", position.longitude())
                .number(attribute, value);
        return LargeRecords.reduced(record, read.toBytes());
    }
}
