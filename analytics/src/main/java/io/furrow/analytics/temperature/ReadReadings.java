package io.furrow.analytics.temperature;

import java.time.Instant;
import java.util.Map;
import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.AheadLimit;
import io.furrow.flink.DeadLetters;
import io.furrow.flink.Epochs;
import io.furrow.flink.LargeRecords;
import io.furrow.flink.ReplayKind;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.EntityReader;
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.PositionReading;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Takes the readings of one attribute out of reported entities. Unreadable records and those from the future, counted as {@code
 * rejected}, become dead letters, but those of {@code data.raw}, which {@code ingest} sets aside. Everything else that is no reading is
 * counted: {@code skipped} (a deletion, a result, an entity without the attribute, what only tells where a replay begins or ends),
 * {@code faulty} (a value that is no finite number, a position
 * that cannot be right), {@code unlocated} (no position).
 */
final class ReadReadings extends ProcessFunction<TopicRecord, Reading> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "temperature";
    /** The results of Furrow itself, which come back through the context broker. */
    private static final String OWN_TYPES = "Analytics:";
    /** Nothing is that warm; sums and differences of greater doubles could leave the range of doubles. */
    private static final double GREATEST = 1e100;

    private final String attribute;
    private final AheadLimit ahead;
    private transient EntityReader entity;
    private transient Counter accepted;
    private transient Counter rejected;
    private transient Counter skipped;
    private transient Counter faulty;
    private transient Counter unlocated;

    ReadReadings(String attribute, AheadLimit ahead) {
        this.attribute = attribute;
        this.ahead = ahead;
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
            ahead.check(record);
            Epochs.timeOf(record); // refuses what tells none, an end too
            boolean isEvent = ReplayKind.of(record) == ReplayKind.EVENT;
            if (isEvent) {
                entity.read(record.value());
            }
            if (!isEvent || entity.type().startsWith(OWN_TYPES) || !entity.has(attribute)) {
                skipped.inc();
            } else {
                measured(record, out);
            }
        } catch (UnreadableException e) {
            rejected.inc();
            if (!DeadLetters.areOfIngest(record)) {
                context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
            }
        }
    }

    private void measured(TopicRecord record, Collector<Reading> out) throws UnreadableException {
        double value = entity.number(attribute);
        PositionReading place = entity.position();
        if (!(Math.abs(value) <= GREATEST) || place instanceof PositionReading.Faulty) {
            faulty.inc();
        } else if (place instanceof PositionReading.Located located) {
            long time = Epochs.timeOf(record);
            accepted.inc();
            Map<String, String> headers = record.headers();
            FiwareScope scope = FiwareScope.of(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH));
            String eventId = headers.containsKey(HeaderNames.CE_ID)
                    ? idOf(headers.get(HeaderNames.CE_ID), Epochs.of(time))
                    : EventId.of(scope, Entity.parse(record.value()), Instant.ofEpochMilli(time));
            TopicRecord kept = LargeRecords.isLarge(record) ? excerpt(record, located.position(), value) : record;
            out.collect(new Reading(entity.id(), scope, located.position(), value, eventId, kept));
        } else {
            unlocated.inc();
        }
    }

    /** The same event in another epoch is no repetition. */
    private static String idOf(String event, long epoch) {
        return epoch == 0 ? event : event + ":" + epoch;
    }

    /** What the job read of it: an image need not go through windows only to be late. */
    private TopicRecord excerpt(TopicRecord record, Position position, double value) {
        EntityBuilder read = Entity.builder(entity.id(), entity.type())
                .number("Latitude", position.latitude())
                .number("Longitude", position.longitude())
                .number(attribute, value);
        return LargeRecords.reduced(record, read.toBytes());
    }
}
