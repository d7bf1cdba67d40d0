package io.furrow.analytics.temperature;

import java.time.Instant;
import java.util.Map;
import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityReader;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Takes the readings of one attribute out of reported entities. Unreadable records become dead letters. Everything else that
 * is no reading is counted: {@code skipped} (a deletion, a result, an entity without the attribute), {@code faulty} (a value
 * that is no finite number, a position that cannot be right), {@code unlocated} (no position).
 */
final class ReadReadings extends ProcessFunction<TopicRecord, Reading> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "temperature";
    /** The results of Furrow itself, which come back through the context broker. */
    private static final String OWN_TYPES = "Analytics:";
    /** Nothing is that warm; sums and differences of greater doubles could leave the range of doubles. */
    private static final double GREATEST = 1e100;

    private final String attribute;
    private transient EntityReader entity;
    private transient Counter accepted;
    private transient Counter rejected;
    private transient Counter skipped;
    private transient Counter faulty;
    private transient Counter unlocated;

    ReadReadings(String attribute) {
        this.attribute = attribute;
    }

    @Override
    public void open(OpenContext context) {
        entity = new EntityReader(Set.of(attribute));
        MetricGroup metrics = getRuntimeContext().getMetricGroup();
        accepted = metrics.counter("accepted");
        rejected = metrics.counter("rejected");
        skipped = metrics.counter("skipped");
        faulty = metrics.counter("faulty");
        unlocated = metrics.counter("unlocated");
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<Reading> out) {
        if (record.value() == null) {
            skipped.inc();
            return;
        }
        try {
            entity.read(record.value());
            if (entity.type().startsWith(OWN_TYPES) || !entity.has(attribute)) {
                skipped.inc();
            } else {
                measured(record, out);
            }
        } catch (UnreadableException e) {
            rejected.inc();
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
        }
    }

    private void measured(TopicRecord record, Collector<Reading> out) throws UnreadableException {
        double value = entity.number(attribute);
        PositionReading place = entity.position();
        if (!(Math.abs(value) <= GREATEST) || place instanceof PositionReading.Faulty) {
            faulty.inc();
        } else if (place instanceof PositionReading.Located located) {
            accepted.inc();
            Map<String, String> headers = record.headers();
            FiwareScope scope = FiwareScope.of(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH));
            String eventId = headers.containsKey(HeaderNames.CE_ID)
                    ? headers.get(HeaderNames.CE_ID)
                    : EventId.of(scope, Entity.parse(record.value()), Instant.ofEpochMilli(record.timestamp()));
            out.collect(new Reading(entity.id(), scope, located.position(), value, eventId, record));
        } else {
            unlocated.inc();
        }
    }
}
