package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.function.Supplier;

import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Sorts;
import org.bson.RawBsonDocument;

import io.furrow.mission.RecordingException;

/**
 * Lists the missions that are stored in MongoDB: by the names of collections, and by the first and last entry of their
 * index on event time.
 */
public final class MissionCatalog extends StoredDatabase {
    /** Of the missions that these recordings open. */
    MissionCatalog(MongoRecordings recordings) {
        super(recordings);
    }

    /**
     * Does not wait for the server.
     *
     * @param database {@link MongoAccess#DATABASE} unless missions were moved
     * @throws IllegalArgumentException if the URI is none
     */
    public static MissionCatalog open(String uri, String database) {
        return new MissionCatalog(new MongoRecordings(uri, database));
    }

    /**
     * All missions, by name.
     *
     * @throws RecordingException if MongoDB cannot be asked now
     */
    List<StoredMission> list() throws RecordingException {
        return answer(() -> {
            List<StoredMission> missions = new ArrayList<>();
            for (String name : database().listCollectionNames()) {
                if (name.startsWith(MissionCollections.PREFIX)) {
                    missions.add(stored(name));
                }
            }
            missions.sort(Comparator.comparing(StoredMission::name));
            return missions;
        });
    }

    /**
     * What stands for each mission in topics and collections, in alphabetical order; reads no document.
     *
     * @throws RecordingException if MongoDB cannot be asked now
     */
    public List<String> topicNames() throws RecordingException {
        return answer(() -> {
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
     * A mission by its name, or by what stands for it in topics and collections; empty if it is not stored.
     *
     * @throws RecordingException if MongoDB cannot be asked now
     */
    public Optional<StoredMission> find(String mission) throws RecordingException {
        return answer(() -> MongoRecordings.collectionOf(database(), mission).map(this::stored));
    }

    /**
     * Whether a replay of this mission finds it; reads no document.
     *
     * @throws RecordingException if MongoDB cannot be asked now
     */
    boolean has(String mission) throws RecordingException {
        return answer(() -> MongoRecordings.collectionOf(database(), mission).isPresent());
    }

    private StoredMission stored(String name) {
        MongoCollection<RawBsonDocument> collection = database().getCollection(name, RawBsonDocument.class);
        String mission = MissionCollections.missionOf(
                name,
                () -> collection
                        .find()
                        .sort(Sorts.descending(EventDocumentCodec.TIME))
                        .first());
        return new StoredMission(mission, name, MongoRecording.span(collection));
    }

    private <T> T answer(Supplier<T> question) throws RecordingException {
        return answer("Which missions are stored cannot be read from", question);
    }
}
