package io.furrow.mission.mongo;

import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.Date;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;
import java.util.stream.StreamSupport;

import com.mongodb.MongoCommandException;
import com.mongodb.MongoException;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoDatabase;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.IndexOptions;
import com.mongodb.client.model.Indexes;
import org.bson.BsonDocument;
import org.bson.BsonValue;
import org.bson.Document;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.topic.TopicName;

/**
 * The collections {@code mission_<mission>} of the database {@code persistence}, each with an index on event time and one on
 * entity and event time. Retention is the server's business where it removes expired documents itself; {@link #purge} does it
 * where it does not. Several threads may use it.
 */
public final class MissionCollections {
    private static final Logger LOG = LoggerFactory.getLogger(MissionCollections.class);

    public static final String PREFIX = "mission_";
    private static final String BY_TIME = "event-time";
    static final String BY_ENTITY = "entity-and-event-time";
    /** An index of the same name with other options, and one of the same keys under another name. */
    private static final Set<Integer> OTHER_OPTIONS = Set.of(85, 86);

    /**
     * The server alters no index, or not this one: no right, no such field, name or command; before MongoDB 5.1 one that removes
     * nothing so far.
     */
    private static final Set<Integer> NOT_ALTERABLE = Set.of(2, 9, 13, 27, 59, 72, 115, 238, 40415);
    /** The most that a server takes; an index that removes documents cannot be told to remove none. */
    private static final long FOR_EVER_SECONDS = Integer.MAX_VALUE;

    private static final Duration PREPARED_FOR = Duration.ofMinutes(1);

    private final MongoDatabase database;
    private final Retention retention;
    private final Clock clock;
    /** When the indexes of a collection were made. */
    private final Map<String, Instant> prepared = new ConcurrentHashMap<>();

    private volatile Boolean expires;

    /** @param retention null to leave that of each collection as it is */
    public MissionCollections(MongoClient client, Retention retention, Clock clock) {
        this(client, retention, clock, null);
    }

    /** @param expires whether the server removes what has expired; null to ask it */
    public MissionCollections(MongoClient client, Retention retention, Clock clock, Boolean expires) {
        this.expires = expires;
        this.database = client.getDatabase(MongoAccess.DATABASE);
        this.retention = retention;
        this.clock = clock;
    }

    /** The mission's name is encoded as in topics, so that no two missions share a collection. */
    public static String nameOf(String mission) {
        return PREFIX + TopicName.of(mission);
    }

    /**
     * The mission of a collection. A hash is the name that an event of its mission bears, where it bears one, else it stays.
     *
     * @param event of the mission, asked for only where it is needed; may give null
     */
    public static String missionOf(String collection, Supplier<? extends BsonDocument> event) {
        String part = collection.substring(PREFIX.length());
        return TopicName.original(part).orElseGet(() -> {
            BsonDocument found = event.get();
            BsonValue attribute = found == null ? null : found.get("Mission");
            BsonValue value = attribute instanceof BsonDocument own ? own.get("value") : null;
            boolean isIt = value != null
                    && value.isString()
                    && nameOf(value.asString().getValue()).equals(collection);
            return isIt ? value.asString().getValue() : part;
        });
    }

    /** The collections that may hold a mission, the likeliest first: by its name, or by what stands for it in topics. */
    public static List<String> candidates(String mission) {
        boolean looksEncoded = mission.startsWith("_x-") || mission.startsWith("_h-");
        return looksEncoded ? List.of(nameOf(mission), PREFIX + mission) : List.of(nameOf(mission));
    }

    public MongoCollection<RawBsonDocument> get(String name) {
        return database.getCollection(name, RawBsonDocument.class);
    }

    /** All that exist, in alphabetical order. */
    public List<String> names() {
        return StreamSupport.stream(database.listCollectionNames().spliterator(), false)
                .filter(name -> name.startsWith(PREFIX))
                .sorted()
                .toList();
    }

    /** The collection with its indexes, which are made at the first use; once a minute again, as it may have been dropped. */
    public MongoCollection<RawBsonDocument> prepared(String name) {
        MongoCollection<RawBsonDocument> collection = get(name);
        Instant now = clock.instant();
        if (now.isAfter(prepared.getOrDefault(name, Instant.MIN))) {
            IndexOptions byTime = new IndexOptions().name(BY_TIME);
            Optional<Duration> kept = retention != null && serverExpires() ? retention.of(name) : Optional.empty();
            kept.ifPresent(time -> byTime.expireAfter(time.toSeconds(), TimeUnit.SECONDS));
            ensureIndex(collection, Indexes.ascending(EventDocumentCodec.TIME), byTime);
            ensureIndex(
                    collection,
                    Indexes.ascending(EventDocumentCodec.ENTITY_ID, EventDocumentCodec.TIME),
                    new IndexOptions().name(BY_ENTITY));
            prepared.put(name, now.plus(PREPARED_FOR));
        }
        return collection;
    }

    private void ensureIndex(MongoCollection<?> collection, Bson keys, IndexOptions options) {
        try {
            collection.createIndex(keys, options);
        } catch (MongoCommandException e) {
            if (!OTHER_OPTIONS.contains(e.getErrorCode())) {
                throw e;
            }
            if (retention != null && !isAltered(collection, options)) {
                collection.dropIndex(keys);
                collection.createIndex(keys, options);
            }
        }
    }

    /** Whether the server keeps the index with another retention: to build it anew takes hours where a mission is large. */
    private boolean isAltered(MongoCollection<?> collection, IndexOptions options) {
        if (!BY_TIME.equals(options.getName())) {
            return false;
        }
        Long seconds = options.getExpireAfter(TimeUnit.SECONDS);
        Document index = new Document("name", BY_TIME)
                .append("expireAfterSeconds", seconds == null ? FOR_EVER_SECONDS : seconds);
        try {
            database.runCommand(
                    new Document("collMod", collection.getNamespace().getCollectionName()).append("index", index));
            return true;
        } catch (MongoCommandException e) {
            if (!NOT_ALTERABLE.contains(e.getErrorCode())) {
                throw e;
            }
            LOG.info("The server rebuilds the index {} of {}: {}", BY_TIME, collection.getNamespace(), e.getMessage());
            return false;
        }
    }

    /** The indexes of a collection by name, and of each after what time it removes documents, if at all. */
    public Map<String, Optional<Duration>> indexes(String collection) {
        Map<String, Optional<Duration>> indexes = new TreeMap<>();
        for (Document index : database.getCollection(collection).listIndexes()) {
            Object seconds = index.get("expireAfterSeconds");
            indexes.put(
                    index.getString("name"),
                    seconds instanceof Number number && number.longValue() < FOR_EVER_SECONDS
                            ? Optional.of(Duration.ofSeconds(number.longValue()))
                            : Optional.empty());
        }
        return indexes;
    }

    /** Of a collection's documents; −1 if the server does not report it. */
    public long bytes(String collection) {
        try {
            Object size =
                    database.runCommand(new Document("collStats", collection)).get("size");
            return size instanceof Number number ? number.longValue() : -1;
        } catch (MongoCommandException e) {
            LOG.debug("no size of {}", collection, e);
            return -1;
        }
    }

    /** Whether it can be reached at this moment. */
    public boolean serverAnswers() {
        try {
            database.runCommand(new Document("ping", 1));
            return true;
        } catch (MongoException e) {
            return false;
        }
    }

    /** Whether the server has an index that removes what has expired; a server that keeps its data by other means has not. */
    public boolean serverExpires() {
        if (expires == null) {
            expires = hasIndexes(database);
        }
        return expires;
    }

    /** Whether the server keeps indexes and removes what has expired. */
    static boolean hasIndexes(MongoDatabase database) {
        return database.runCommand(new Document("buildInfo", 1)).containsKey("storageEngines");
    }

    /**
     * Removes what has expired.
     *
     * @return how many documents
     */
    public long purge() {
        long removed = 0;
        for (String name : names()) {
            Optional<Duration> kept = retention.of(name);
            if (kept.isPresent()) {
                Date expired = Date.from(clock.instant().minus(kept.get()));
                removed += get(name)
                        .deleteMany(Filters.lt(EventDocumentCodec.TIME, expired))
                        .getDeletedCount();
            }
        }
        return removed;
    }
}
