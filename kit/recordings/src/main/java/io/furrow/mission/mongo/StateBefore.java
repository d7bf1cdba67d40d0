package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.mongodb.client.AggregateIterable;
import com.mongodb.client.FindIterable;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Accumulators;
import com.mongodb.client.model.Aggregates;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Sorts;
import org.bson.BsonDateTime;
import org.bson.BsonDocument;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;

import io.furrow.mission.EventOrder;
import io.furrow.mission.LatestState;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Finds the last state of a mission's entities from their newest documents before a point: one query for the oldest
 * document of each entity, one for the newest documents of all, then further ones for each unsettled entity, with the
 * index on entity and event time. An entity is settled by its deletion, by all of its documents, or by its newest
 * document if that has every attribute of the {@value #MIN_EVENTS} documents before it and of the oldest, as is the
 * case if the context broker notifies whole entities. Other entities report only changes. An entity that shares its id is
 * found if the oldest document of the id, or one of those newest ones, is of it.
 */
final class StateBefore {
    private static final int MIN_EVENTS = 8;
    private static final int FIRST_LIMIT = 2 * MIN_EVENTS;
    private static final int GROWTH = 4;
    private static final String OLDEST = "oldest";

    private final MongoCollection<RawBsonDocument> collection;
    private final Bson before;
    private final Set<String> entities;
    private final long time;
    private final Bounds bounds;

    /**
     * Limits above which the mission is read from its beginning instead.
     *
     * @param newest documents of the query for all entities
     * @param lookups entities with a query of their own
     * @param perEntity documents of one entity per query, at least {@value #FIRST_LIMIT}
     * @param bytes of documents per query
     */
    record Bounds(int newest, int lookups, int perEntity, long bytes) {
        private static final long BYTES = 8L * 1024 * 1024;

        static final Bounds INDEXED = new Bounds(2_000, 1_000, 256, BYTES);
    }

    /**
     * The newest documents of a query.
     *
     * @param events in their order; invalid documents are omitted
     * @param all whether there are no others
     */
    private record Newest(List<StoredEvent> events, boolean all) {}

    /**
     * @param time epoch ms
     * @param entities ids of the requested entities; empty for all
     */
    StateBefore(MongoCollection<RawBsonDocument> collection, long time, Set<String> entities, Bounds bounds) {
        this.collection = collection;
        this.time = time;
        this.entities = entities;
        this.bounds = bounds;
        Bson earlier = Filters.lt(EventDocumentCodec.TIME, new BsonDateTime(time));
        before = Filters.and(OrderedDocumentReader.NOT_ARRAY, earlier);
    }

    /** Returns the states, in the order of their newest events; empty if the bounds are exceeded. */
    Optional<List<StoredEvent>> read() throws RecordingInterruptedException {
        Map<String, Optional<StoredEvent>> oldest = oldest();
        if (oldest.size() > bounds.newest() + bounds.lookups()) {
            return Optional.empty();
        }
        Newest shared = newest(requested(), bounds.newest());
        Map<String, List<StoredEvent>> byEntity = new HashMap<>();
        shared.events()
                .forEach(event -> byEntity.computeIfAbsent(event.entityId(), id -> new ArrayList<>())
                        .add(event));
        List<StoredEvent> state = new ArrayList<>();
        List<String> unsettled = new ArrayList<>();
        oldest.forEach((id, first) -> {
            Newest own = new Newest(byEntity.getOrDefault(id, List.of()), shared.all());
            settled(own, first).ifPresentOrElse(state::addAll, () -> unsettled.add(id));
        });
        if (unsettled.size() > bounds.lookups()) {
            return Optional.empty();
        }
        for (String id : unsettled) {
            Optional<List<StoredEvent>> found = readEntity(id, oldest.get(id));
            if (found.isEmpty()) {
                return Optional.empty();
            }
            state.addAll(found.get());
        }
        state.sort(EventOrder.COMPARATOR);
        return Optional.of(state);
    }

    /** Returns the oldest event of each entity that may have one before the point; empty for an invalid document. */
    private Map<String, Optional<StoredEvent>> oldest() throws RecordingInterruptedException {
        List<Bson> stages = new ArrayList<>();
        if (!entities.isEmpty()) {
            stages.add(Aggregates.match(Filters.in(EventDocumentCodec.ENTITY_ID, entities)));
        }
        stages.add(Aggregates.sort(Sorts.ascending(EventDocumentCodec.ENTITY_ID, EventDocumentCodec.TIME)));
        stages.add(Aggregates.group("$" + EventDocumentCodec.ENTITY_ID, Accumulators.first(OLDEST, "$$ROOT")));
        AggregateIterable<RawBsonDocument> groups =
                collection.aggregate(stages).hintString(MissionCollections.BY_ENTITY);
        Map<String, Optional<StoredEvent>> oldest = new LinkedHashMap<>();
        try (MongoCursor<RawBsonDocument> each = groups.cursor()) {
            while (each.hasNext() && oldest.size() <= bounds.newest() + bounds.lookups()) {
                RecordingInterruptedException.check();
                RawBsonDocument group = each.next();
                Optional<StoredEvent> first = event(group.getDocument(OLDEST));
                if (group.isString(EventDocumentCodec.ID)
                        && first.map(StoredEvent::time).orElse(Long.MIN_VALUE) < time) {
                    oldest.put(group.getString(EventDocumentCodec.ID).getValue(), first);
                }
            }
        }
        return oldest;
    }

    private Bson requested() {
        return entities.isEmpty() ? before : Filters.and(Filters.in(EventDocumentCodec.ENTITY_ID, entities), before);
    }

    private Newest newest(Bson filter, int limit) throws RecordingInterruptedException {
        FindIterable<RawBsonDocument> newest = collection
                .find(filter)
                .sort(Sorts.descending(EventDocumentCodec.TIME))
                .limit(limit)
                .batchSize(limit);
        List<OrderedDocumentReader.Ordered> read = new ArrayList<>();
        long bytes = 0;
        try (MongoCursor<RawBsonDocument> documents = newest.cursor()) {
            while (bytes <= bounds.bytes() && documents.hasNext()) {
                RecordingInterruptedException.check();
                read.add(OrderedDocumentReader.Ordered.of(documents.next()));
                bytes += read.get(read.size() - 1).bytes();
            }
        }
        boolean all = read.size() < limit && bytes <= bounds.bytes();
        long truncatedTime = all || read.isEmpty()
                ? Long.MIN_VALUE
                : read.get(read.size() - 1).time();
        List<StoredEvent> events = new ArrayList<>();
        for (OrderedDocumentReader.Ordered document : read) {
            if (all || document.time() > truncatedTime) { // the oldest millisecond may be incomplete
                event(document.document()).ifPresent(events::add);
            }
        }
        events.sort(EventOrder.COMPARATOR);
        return new Newest(events, all);
    }

    private Optional<List<StoredEvent>> readEntity(String id, Optional<StoredEvent> oldest)
            throws RecordingInterruptedException {
        Bson own = Filters.and(Filters.eq(EventDocumentCodec.ENTITY_ID, id), before);
        for (int limit = FIRST_LIMIT; limit <= bounds.perEntity(); limit *= GROWTH) {
            Optional<List<StoredEvent>> found = settled(newest(own, limit), oldest);
            if (found.isPresent()) {
                return found;
            }
        }
        return Optional.empty();
    }

    /**
     * Returns the states of an id, which entities of several tenants and types may share; empty if its newest events do
     * not determine them.
     */
    private static Optional<List<StoredEvent>> settled(Newest newest, Optional<StoredEvent> oldest) {
        List<StoredEvent> events = newest.events();
        boolean settled = newest.all()
                || isOfOneEntity(events, oldest) && (hasDeletion(events) || isComplete(events, oldest.orElseThrow()));
        return settled ? Optional.of(LatestState.of(events)) : Optional.empty();
    }

    private static boolean isOfOneEntity(List<StoredEvent> events, Optional<StoredEvent> oldest) {
        return oldest.isPresent() && events.stream().allMatch(event -> LatestState.isOfOneEntity(event, oldest.get()));
    }

    private static boolean hasDeletion(List<StoredEvent> events) {
        return events.stream().anyMatch(event -> event.entity() == null);
    }

    /** Returns whether the newest event has all attributes of the others. */
    private static boolean isComplete(List<StoredEvent> events, StoredEvent oldest) {
        if (events.size() <= MIN_EVENTS) {
            return false;
        }
        Set<String> names = names(events.get(events.size() - 1));
        return names.containsAll(names(oldest)) && events.stream().allMatch(event -> names.containsAll(names(event)));
    }

    private static Set<String> names(StoredEvent event) {
        Set<String> names = new HashSet<>();
        if (event.entity() != null) {
            event.entity().fieldNames().forEachRemaining(names::add);
        }
        return names;
    }

    private static Optional<StoredEvent> event(BsonDocument document) {
        try {
            return Optional.of(OrderedDocumentReader.event(document));
        } catch (UnreadableException e) { // reported with its page
            return Optional.empty();
        }
    }
}
