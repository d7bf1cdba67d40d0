package io.furrow.ingest.route;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Set;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.metrics.Counter;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.model.event.EntityDeletion;
import io.furrow.model.event.EventId;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.event.Origin;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Parses the parts of an event that routing needs; a record without a value is the deletion of the entity of its key. Emits dead letters
 * for other records, and for those from the future. If {@code data.latest} is keyed by id, it counts ids that several tenants or service
 * paths share, {@code idsShared}, and warns of the first.
 */
public final class ParseEvents extends ProcessFunction<TopicRecord, ReportedEvent> {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(ParseEvents.class);
    private static final String STAGE = "ingest";
    private static final Set<String> ROUTE = Set.of("Domain", "Mission");

    private final ClockSkewLimit ahead;
    private final boolean keysById;
    private transient DeadLetterCounters dead;
    private transient SharedIds ids;
    private transient Counter shared;

    /** @param keysById whether entities of one id share a key on {@code data.latest} */
    public ParseEvents(ClockSkewLimit ahead, boolean keysById) {
        this.ahead = ahead;
        this.keysById = keysById;
    }

    @Override
    public void open(OpenContext context) {
        dead = new DeadLetterCounters(getRuntimeContext().getMetricGroup());
        ids = new SharedIds();
        shared = getRuntimeContext().getMetricGroup().counter("idsShared");
    }

    @Override
    public void processElement(TopicRecord record, Context context, Collector<ReportedEvent> out) {
        try {
            ahead.check(record);
            ReportedEvent event = recognize(record);
            countSharedId(event);
            out.collect(event);
        } catch (UnreadableException e) {
            dead.count(e.reason());
            context.output(DeadLetters.TAG, DeadLetters.of(record, e, STAGE));
        }
    }

    private void countSharedId(ReportedEvent event) {
        FiwareScope other = keysById ? ids.take(event) : null;
        if (other == null) {
            return;
        }
        if (shared.getCount() == 0) {
            FiwareScope its = FiwareScope.ofIdentity(event.identity());
            LOG.warn(
                    "tenant '{}', path '{}' and tenant '{}', path '{}' both have an entity '{}': they share a key on data.latest, and"
                            + " compaction keeps one of them. Start ingest with --latest-key identity.",
                    other.service(),
                    other.servicePath(),
                    its.service(),
                    its.servicePath(),
                    event.entityId());
        }
        shared.inc();
    }

    long idsShared() {
        return shared.getCount();
    }

    /** A record of another producer may lack the event id: it gets the one that the source would have assigned. */
    static ReportedEvent recognize(TopicRecord record) throws UnreadableException {
        FiwareScope scope = FiwareScope.of(record.headers());
        return record.value() == null ? deletion(record, scope) : change(record, scope);
    }

    private static ReportedEvent change(TopicRecord record, FiwareScope scope) throws UnreadableException {
        String known = knownId(record);
        Entity entity = known == null ? Entity.parse(record.value()) : Entity.parse(record.value(), ROUTE);
        String id = known == null ? EventId.of(scope, entity, Instant.ofEpochMilli(record.timestamp())) : known;
        return new ReportedEvent(
                id,
                scope.identity(entity.id()),
                entity.id(),
                entity.type(),
                entity.name("Domain").orElse(""),
                entity.name("Mission").orElse(""),
                known == null ? record.with(HeaderNames.CE_ID, id) : record);
    }

    /** Null if there is none: an empty one would make all events of an entity duplicates of the first. */
    private static String knownId(TopicRecord record) {
        String id = record.headers().get(HeaderNames.CE_ID);
        return id == null || id.isBlank() ? null : id;
    }

    private static ReportedEvent deletion(TopicRecord record, FiwareScope scope) throws UnreadableException {
        if (record.key() == null || record.key().length == 0) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "the record has neither a value nor a key");
        }
        String entityId = new String(record.key(), StandardCharsets.UTF_8);
        String known = knownId(record);
        Instant time = Instant.ofEpochMilli(record.timestamp());
        String type = record.headers().getOrDefault(HeaderNames.ENTITY_TYPE, "");
        String id = known == null ? new EntityDeletion(type, entityId, scope, time, time, Origin.KAFKA).id() : known;
        TopicRecord deletion = known == null ? record.with(HeaderNames.CE_ID, id) : record;
        return new ReportedEvent(id, scope.identity(entityId), entityId, type, "", "", deletion);
    }
}
