package io.furrow.mission.marker;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.Date;
import java.util.List;
import java.util.Optional;

import com.mongodb.ErrorCategory;
import com.mongodb.MongoWriteException;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.CountOptions;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.IndexOptions;
import com.mongodb.client.model.Indexes;
import com.mongodb.client.model.Sorts;
import org.bson.BsonType;
import org.bson.Document;

import io.furrow.mission.RecordingException;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;
import io.furrow.mission.mongo.StoredDatabase;

/**
 * Stores the markers of all missions in the collection {@code markers}: {@code _id}, {@code mission} (encoded as in its
 * collection's name), {@code time} (a date), {@code note}, {@code author}, {@code created} (a date), with an index on
 * mission and time. Not thread-safe.
 */
public final class Markers extends StoredDatabase {
    /** Maximum markers per mission. */
    public static final int MAX = 10_000;

    private static final String COLLECTION = "markers";
    private static final String ID = "_id";
    private static final String MISSION = "mission";
    private static final String TIME = "time";
    private static final String NOTE = "note";
    private static final String AUTHOR = "author";
    private static final String CREATED = "created";
    private static final Comparator<Marker> BY_TIME =
            Comparator.comparingLong(Marker::time).thenComparing(Marker::id);

    private final MongoCollection<Document> collection = database().getCollection(COLLECTION);
    private final int max;
    private boolean indexed;

    Markers(MongoRecordings at, int max) {
        super(at);
        this.max = max;
    }

    /**
     * Opens the markers without waiting for the server.
     *
     * @param database {@link MongoAccess#DATABASE} unless missions were moved
     * @throws IllegalArgumentException if the URI is invalid
     */
    public static Markers open(String uri, String database) {
        return new Markers(new MongoRecordings(uri, database), MAX);
    }

    /**
     * Stores a marker; storing the same one again changes nothing, so that callers may retry. It does not check whether
     * the mission and the moment exist.
     *
     * @throws RejectedMarkerException if the mission or the id is missing or longer than 100 characters, the note is
     * blank or longer than 1,000, the author longer than 200, a time is not between 1970 and 9999, another marker has
     * the id, or the mission has {@value #MAX}
     * @throws RecordingException if MongoDB is unavailable
     */
    public void add(Marker marker) throws RejectedMarkerException, RecordingException {
        MarkerRules.check(marker);
        Optional<String> rejection = run(unreachable(marker.mission()), () -> {
            if (!indexed) {
                collection.createIndex(Indexes.ascending(MISSION, TIME), new IndexOptions().name("mission-and-time"));
                indexed = true;
            }
            return insert(marker, missionOf(marker.mission()));
        });
        if (rejection.isPresent()) {
            throw new RejectedMarkerException(rejection.get());
        }
    }

    /** Inserts a marker; returns why it was rejected, or empty. */
    private Optional<String> insert(Marker marker, String mission) {
        try {
            collection.insertOne(new Document(ID, marker.id())
                    .append(MISSION, mission)
                    .append(TIME, new Date(marker.time()))
                    .append(NOTE, marker.note())
                    .append(AUTHOR, marker.author())
                    .append(CREATED, new Date(marker.created())));
        } catch (MongoWriteException e) {
            if (e.getError().getCategory() != ErrorCategory.DUPLICATE_KEY) {
                throw e;
            }
            Document stored = collection.find(Filters.eq(ID, marker.id())).first();
            return stored == null || read(stored, marker.mission(), mission).equals(marker)
                    ? Optional.empty()
                    : Optional.of("There is another marker of id %s; write a new id, or remove that marker first"
                            .formatted(marker.id()));
        }
        // Counted afterwards, because another marker may be added at the same time.
        CountOptions limit = new CountOptions().limit(max + 1);
        if (collection.countDocuments(Filters.eq(MISSION, mission), limit) <= max) {
            return Optional.empty();
        }
        collection.deleteOne(Filters.eq(ID, marker.id()));
        return Optional.of("Mission %s has %,d markers, and no more are stored; remove some first"
                .formatted(marker.mission(), max));
    }

    /**
     * Returns all markers of a mission, in the order of their times, then ids.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    public List<Marker> list(String mission) throws RecordingException {
        return list(mission, 0, Long.MAX_VALUE);
    }

    /**
     * Returns the markers of a part of a mission.
     *
     * @param from epoch ms
     * @param to epoch ms, exclusive
     * @throws RecordingException if MongoDB is unavailable
     */
    public List<Marker> list(String mission, long from, long to) throws RecordingException {
        return run(unreachable(mission), () -> {
            String key = missionOf(mission);
            List<Marker> markers = new ArrayList<>();
            collection
                    .find(Filters.and(
                            Filters.eq(MISSION, key),
                            Filters.gte(TIME, new Date(from)),
                            Filters.lt(TIME, new Date(to)),
                            Filters.not(Filters.type(TIME, BsonType.ARRAY))))
                    .sort(Sorts.ascending(TIME))
                    .limit(max)
                    .forEach(found -> markers.add(read(found, mission, key)));
            markers.sort(BY_TIME);
            return markers;
        });
    }

    /**
     * Removes a marker; returns false if the mission has no such marker.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    public boolean remove(String mission, String id) throws RecordingException {
        return run(
                unreachable(mission),
                () -> collection
                                .deleteOne(Filters.and(Filters.eq(ID, id), Filters.eq(MISSION, missionOf(mission))))
                                .getDeletedCount()
                        > 0);
    }

    /**
     * Removes all markers of a mission; returns how many it had. Called before its events are deleted, by which it is found.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    public long removeAll(String mission) throws RecordingException {
        return run(
                unreachable(mission),
                () -> collection
                        .deleteMany(Filters.eq(MISSION, missionOf(mission)))
                        .getDeletedCount());
    }

    /** @param requestedMission its name, used if the document is of that mission */
    private static Marker read(Document found, String requestedMission, String key) {
        String mission = text(found, MISSION);
        return new Marker(
                text(found, ID),
                mission.equals(key) ? requestedMission : mission,
                time(found, TIME),
                text(found, NOTE),
                text(found, AUTHOR),
                time(found, CREATED));
    }

    private static String text(Document found, String field) {
        return found.get(field) instanceof String text ? text : String.valueOf(found.get(field));
    }

    private static long time(Document found, String field) {
        return found.get(field) instanceof Date date ? date.getTime() : 0;
    }

    /** Returns the name of the mission's collection without its prefix. */
    private String missionOf(String mission) {
        boolean isPlain = MissionCollections.candidates(mission).size() == 1;
        Optional<String> collectionName =
                isPlain ? Optional.empty() : MongoRecordings.collectionOf(database(), mission);
        return collectionName.orElse(MissionCollections.nameOf(mission)).substring(MissionCollections.PREFIX.length());
    }

    private static String unreachable(String mission) {
        return "The markers of mission %s cannot be reached at".formatted(mission);
    }
}
