package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.OptionalLong;
import java.util.function.Supplier;

import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Sorts;
import org.bson.RawBsonDocument;

import io.furrow.mission.RecordingException;

/** Lists and deletes the missions in MongoDB, by the names of collections and the ends of their index on event time. */
public final class MissionCatalog extends StoredDatabase {
    MissionCatalog(MongoRecordings recordings) {
        super(recordings);
    }

    /**
     * Opens the catalog without waiting for the server.
     *
     * @param database {@link MongoAccess#DATABASE} unless missions were moved
     * @throws IllegalArgumentException if the URI is invalid
     */
    public static MissionCatalog open(String uri, String database) {
        return new MissionCatalog(new MongoRecordings(uri, database));
    }

    /**
     * Returns all missions, sorted by name.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    List<StoredMission> list() throws RecordingException {
        return run(() -> {
            List<StoredMission> missions = new ArrayList<>();
            for (String name : database().listCollectionNames()) {
                if (name.startsWith(MissionCollections.PREFIX)) {
                    missions.add(describe(name));
                }
            }
            missions.sort(Comparator.comparing(StoredMission::name));
            return missions;
        });
    }

    /**
     * Returns the encoded names of all missions, as in topics and collections, in alphabetical order; reads no
     * document.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    public List<String> topicNames() throws RecordingException {
        return run(() -> {
            List<String> names = new ArrayList<>();
            for (String name : database().listCollectionNames()) {
                if (name.startsWith(MissionCollections.PREFIX)) {
                    names.add(name.substring(MissionCollections.PREFIX.length()));
                }
            }
            names.sort(Comparator.naturalOrder());
            return names;
        });
    }

    /**
     * Finds a mission by its name or its encoded name in topics and collections; empty if it is not stored.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    public Optional<StoredMission> find(String mission) throws RecordingException {
        return run(() -> MongoRecordings.collectionOf(database(), mission).map(this::describe));
    }

    /**
     * Returns whether a replay finds the mission; reads no document.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    boolean has(String mission) throws RecordingException {
        return run(() -> MongoRecordings.collectionOf(database(), mission).isPresent());
    }

    /**
     * Returns how many events a mission has, as the server remembers it; empty if it is not stored.
     *
     * @throws RecordingException if MongoDB is unavailable
     */
    public OptionalLong events(String mission) throws RecordingException {
        return run(() -> MongoRecordings.collectionOf(database(), mission).stream()
                .mapToLong(name -> database().getCollection(name).estimatedDocumentCount())
                .findFirst());
    }

    /**
     * Deletes all events of a mission, if it is stored.
     *
     * @param mission its name or its encoded name
     * @throws RecordingException if MongoDB is unavailable
     */
    public void delete(String mission) throws RecordingException {
        run("Mission %s cannot be deleted from".formatted(mission), () -> {
            MongoRecordings.collectionOf(database(), mission)
                    .ifPresent(name -> database().getCollection(name).drop());
            return mission;
        });
    }

    private StoredMission describe(String name) {
        MongoCollection<RawBsonDocument> collection = database().getCollection(name, RawBsonDocument.class);
        String mission = MissionCollections.missionOf(
                name,
                () -> collection
                        .find()
                        .sort(Sorts.descending(EventDocumentCodec.TIME))
                        .first());
        return new StoredMission(mission, name, MongoRecording.span(collection));
    }

    private <T> T run(Supplier<T> query) throws RecordingException {
        return run("The list of missions cannot be read from", query);
    }
}
