package io.furrow.mission;

import java.time.Duration;
import java.util.Optional;

import com.mongodb.ConnectionString;
import com.mongodb.MongoException;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoDatabase;
import org.bson.RawBsonDocument;

/**
 * The missions that {@code ingest} keeps in MongoDB. Each recording has its own client.
 *
 * @param uri a connection string; what it says of timeouts goes before what is said here
 * @param database {@link MongoAccess#DATABASE} unless missions were moved
 * @param selectionTimeout how long a question waits for a server that is away before it fails
 */
public record MongoRecordings(String uri, String database, Duration selectionTimeout) implements Recordings {
    /** With a timeout of 5 s. */
    public MongoRecordings(String uri, String database) {
        this(uri, database, MongoAccess.SELECTION_TIMEOUT);
    }

    /** @throws IllegalArgumentException if the URI is none */
    public MongoRecordings {
        new ConnectionString(uri);
    }

    @Override
    public Optional<Recording> open(String mission) throws RecordingException {
        MongoClient client = MongoAccess.open(uri, selectionTimeout);
        boolean known = false;
        try {
            MongoDatabase missions = client.getDatabase(database);
            Optional<String> collection = MissionCollections.candidates(mission).stream()
                    .filter(name -> exists(missions, name))
                    .findFirst();
            known = collection.isPresent();
            return collection.map(name -> new MongoRecording(
                    mission,
                    client,
                    missions.getCollection(name, RawBsonDocument.class),
                    where() + "." + name,
                    OrderedDocuments.Sizes.DEFAULT));
        } catch (MongoException e) {
            throw unreadable(mission, where(), e);
        } finally {
            if (!known) {
                client.close();
            }
        }
    }

    static boolean exists(MongoDatabase database, String collection) {
        for (String name : database.listCollectionNames()) {
            if (name.equals(collection)) {
                return true;
            }
        }
        return false;
    }

    static RecordingException unreadable(String mission, String where, MongoException failure) {
        return new RecordingException(
                "Mission %s cannot be read from %s: %s. Check that MongoDB runs there and answers."
                        .formatted(mission, where, failure.getMessage()),
                failure);
    }

    private String where() {
        return "MongoDB at " + String.join(",", new ConnectionString(uri).getHosts()) + ", " + database;
    }

    /** Holds no password. */
    @Override
    public String toString() {
        return where();
    }
}
