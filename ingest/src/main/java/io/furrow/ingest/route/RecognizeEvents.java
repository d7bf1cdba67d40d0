package io.furrow.ingest.route;

import java.time.Instant;
import java.util.Set;

import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.DeadLetters;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Reads what routing needs of an event; emits dead letters for records that are no entities. */
final class RecognizeEvents extends ProcessFunction<TopicRecord, ReportedEvent> {
    private static final long serialVersionUID = 1L;
    private static final String STAGE = "ingest";
    private static final Set<String> ROUTE = Set.of("Domain", "Mission");

    @Override
    public void processElement(TopicRecord record, Context context, Collector<ReportedEvent> out) {
        if (record.value() == null
                && HeaderNames.TYPE_DELETED.equals(record.headers().get(HeaderNames.CE_TYPE))) {
            return; // a deletion names neither domain nor mission; it stays on the input topic
        }
        try {
            out.collect(recognize(record));
        } catch (UnreadableException e) {
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
        }
    }

    /** A record of another producer may lack the event id: it gets the one that the source would have given. */
    static ReportedEvent recognize(TopicRecord record) throws UnreadableException {
        if (record.value() == null) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "the record has no value");
        }
        String known = record.headers().get(HeaderNames.CE_ID);
        Entity entity = known == null ? Entity.parse(record.value()) : Entity.parse(record.value(), ROUTE);
        FiwareScope scope = FiwareScope.of(
                record.headers().get(HeaderNames.SERVICE), record.headers().get(HeaderNames.SERVICE_PATH));
        String id = known == null ? EventId.of(scope, entity, Instant.ofEpochMilli(record.timestamp())) : known;
        return new ReportedEvent(
                id,
                scope.identity(entity.id()),
                entity.text("Domain").orElse(""),
                entity.text("Mission").orElse(""),
                known == null ? record.with(HeaderNames.CE_ID, id) : record);
    }
}
