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
 * Manages the collections {@code mission_<mission>} of the database {@code persistence}, each with an index on event
 * time and one on entity and event time. If the server removes expired documents, it applies the retention; otherwise
 * {@link #purge} does. Thread-safe.
 */
public final class MissionCollections {
    private static final Logger LOG = LoggerFactory.getLogger(MissionCollections.class);

    public static final String PREFIX = "mission_";
    private static final String BY_TIME = "event-time";
    static final String BY_ENTITY = "entity-and-event-time";
    /** Error codes for an index of the same name with other options, and of the same keys under another name. */
    private static final Set<Integer> OTHER_OPTIONS = Set.of(85, 86);

    /**
     * Error codes if the server cannot alter an index, or not this one: no such field, name or command;
     * before MongoDB 5.1 also an index without expiry.
     */
    private static final Set<Integer> NOT_ALTERABLE = Set.of(2, 9, 27, 59, 72, 115, 238, 40415);

    private static final int UNAUTHORIZED = 13;
    /** Maximum expiry of a server; an index with expiry cannot be altered to one without. */
    private static final long MAX_EXPIRY_SECONDS = Integer.MAX_VALUE;

    private static final Duration INDEX_CHECK_INTERVAL = Duration.ofMinutes(1);

    private final MongoDatabase database;
    private final Retention retention;
    private final Clock clock;
    /** Until when the indexes of a collection count as existing. */
    private final Map<String, Instant> prepared = new ConcurrentHashMap<>();

    private volatile Boolean expires;

    /** @param retention null to keep that of each collection */
    public MissionCollections(MongoClient client, Retention retention, Clock clock) {
        this(client, retention, clock, null);
    }

    /** @param expires whether the server removes expired documents; null to ask it */
    public MissionCollections(MongoClient client, Retention retention, Clock clock, Boolean expires) {
        this.expires = expires;
        this.database = client.getDatabase(MongoAccess.DATABASE);
        this.retention = retention;
        this.clock = clock;
    }

    /**
     * Returns the collection of a mission; names are encoded as in topics, so that no two missions share a collection.
     */
    public static String nameOf(String mission) {
        return PREFIX + TopicName.of(mission);
    }

    /**
     * Returns the mission of a collection. If the collection's name contains a hash, the name is read from an event of
     * the mission; if the event has none, the hash is returned.
     *
     * @param event an event of the mission, read only for a hash; may return null
     */
    public static String missionOf(String collection, Supplier<? extends BsonDocument> event) {
        String part = collection.substring(PREFIX.length());
        return TopicName.original(part).orElseGet(() -> {
            BsonDocument found = event.get();
            BsonValue attribute = found == null ? null : found.get("Mission");
            BsonValue value = attribute instanceof BsonDocument own ? own.get("value") : null;
            boolean isOfCollection = value != null
                    && value.isString()
                    && nameOf(value.asString().getValue()).equals(collection);
            return isOfCollection ? value.asString().getValue() : part;
        });
    }

    /** Returns the possible collections of a mission or its encoded name in topics, the most likely first. */
    public static List<String> candidates(String mission) {
        boolean looksEncoded = mission.startsWith("_x-") || mission.startsWith("_h-");
        return looksEncoded ? List.of(nameOf(mission), PREFIX + mission) : List.of(nameOf(mission));
    }

    public MongoCollection<RawBsonDocument> get(String name) {
        return database.getCollection(name, RawBsonDocument.class);
    }

    /** Returns the names of all collections in alphabetical order. */
    public List<String> names() {
        return StreamSupport.stream(database.listCollectionNames().spliterator(), false)
                .filter(name -> name.startsWith(PREFIX))
                .sorted()
                .toList();
    }

    /** Returns the collection after creating its indexes; repeated once a minute, because it may have been dropped. */
    public MongoCollection<RawBsonDocument> prepared(String name) {
        MongoCollection<RawBsonDocument> collection = get(name);
        Instant now = clock.instant();
        if (now.isAfter(prepared.getOrDefault(name, Instant.MIN))) {
            IndexOptions byTime = new IndexOptions().name(BY_TIME);
            Optional<Duration> expiry = retention != null && serverExpires() ? retention.of(name) : Optional.empty();
            expiry.ifPresent(time -> byTime.expireAfter(time.toSeconds(), TimeUnit.SECONDS));
            ensureIndex(collection, Indexes.ascending(EventDocumentCodec.TIME), byTime);
            ensureIndex(
                    collection,
                    Indexes.ascending(EventDocumentCodec.ENTITY_ID, EventDocumentCodec.TIME),
                    new IndexOptions().name(BY_ENTITY));
            prepared.put(name, now.plus(INDEX_CHECK_INTERVAL));
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
            if (retention != null && !alter(collection, options)) {
                collection.dropIndex(keys);
                collection.createIndex(keys, options);
            }
        }
    }

    /**
     * Tries to alter the retention of an index, because rebuilding it takes hours for a large mission.
     *
     * @return false if the server rebuilds it instead
     */
    private boolean alter(MongoCollection<?> collection, IndexOptions options) {
        if (!BY_TIME.equals(options.getName())) {
            return false;
        }
        Long seconds = options.getExpireAfter(TimeUnit.SECONDS);
        Document index = new Document("name", BY_TIME)
                .append("expireAfterSeconds", seconds == null ? MAX_EXPIRY_SECONDS : seconds);
        try {
            database.runCommand(
                    new Document("collMod", collection.getNamespace().getCollectionName()).append("index", index));
            return true;
        } catch (MongoCommandException e) {
            if (e.getErrorCode() == UNAUTHORIZED) {
                LOG.warn(
                        "The retention of {} stays as it is, because the user of MongoDB lacks the permission for collMod; grant the role dbAdmin on {}",
                        collection.getNamespace(),
                        database.getName());
                return true;
            }
            if (!NOT_ALTERABLE.contains(e.getErrorCode())) {
                throw e;
            }
            LOG.info("The server rebuilds the index {} of {}: {}", BY_TIME, collection.getNamespace(), e.getMessage());
            return false;
        }
    }

    /** Returns the indexes of a collection by name, with the time after which they remove documents, if any. */
    public Map<String, Optional<Duration>> indexes(String collection) {
        Map<String, Optional<Duration>> indexes = new TreeMap<>();
        for (Document index : database.getCollection(collection).listIndexes()) {
            Object seconds = index.get("expireAfterSeconds");
            indexes.put(
                    index.getString("name"),
                    seconds instanceof Number number && number.longValue() < MAX_EXPIRY_SECONDS
                            ? Optional.of(Duration.ofSeconds(number.longValue()))
                            : Optional.empty());
        }
        return indexes;
    }

    /** Returns the size of a collection's documents; −1 if the server does not report it. */
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

    /** Returns whether the server answers a ping. */
    public boolean serverAnswers() {
        try {
            database.runCommand(new Document("ping", 1));
            return true;
        } catch (MongoException e) {
            return false;
        }
    }

    /** Returns whether the server removes expired documents; servers with another storage do not. */
    public boolean serverExpires() {
        if (expires == null) {
            expires = hasIndexes(database);
        }
        return expires;
    }

    /** Returns whether the server uses indexes and removes expired documents. */
    static boolean hasIndexes(MongoDatabase database) {
        return database.runCommand(new Document("buildInfo", 1)).containsKey("storageEngines");
    }

    /**
     * Removes expired documents.
     *
     * @return number of removed documents
     */
    public long purge() {
        long removed = 0;
        for (String name : names()) {
            Optional<Duration> expiry = retention.of(name);
            if (expiry.isPresent()) {
                Date expired = Date.from(clock.instant().minus(expiry.get()));
                removed += get(name)
                        .deleteMany(Filters.lt(EventDocumentCodec.TIME, expired))
                        .getDeletedCount();
            }
        }
        return removed;
    }
}
