package io.furrow.mission.mongo;

import java.time.Duration;
import java.util.Optional;

import com.mongodb.ConnectionString;
import com.mongodb.MongoException;
import com.mongodb.MongoInterruptedException;
import com.mongodb.client.MongoDatabase;
import org.bson.RawBsonDocument;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.Recordings;
import io.furrow.model.text.FailureText;

/**
 * Opens the missions that {@code ingest} stores in MongoDB. All open recordings of a server in a process share a
 * client.
 *
 * @param uri a connection string; its timeouts override those given here
 * @param database {@link MongoAccess#DATABASE} unless missions were moved
 * @param selectionTimeout how long a read waits for an unavailable server
 */
public record MongoRecordings(String uri, String database, Duration selectionTimeout) implements Recordings {
    /** Uses a selection timeout of 5 s. */
    public MongoRecordings(String uri, String database) {
        this(uri, database, MongoAccess.SELECTION_TIMEOUT);
    }

    /** @throws IllegalArgumentException if the URI is invalid */
    public MongoRecordings {
        new ConnectionString(uri);
    }

    @Override
    public Optional<Recording> open(String mission) throws RecordingException {
        SharedMongoClient client = SharedMongoClient.of(uri, selectionTimeout);
        boolean isStored = false;
        try {
            MongoDatabase missions = client.client().getDatabase(database);
            Optional<String> collection = collectionOf(missions, mission);
            isStored = collection.isPresent();
            return collection.map(name -> new MongoRecording(
                    mission,
                    client,
                    missions.getCollection(name, RawBsonDocument.class),
                    where() + "." + name,
                    OrderedDocumentReader.Sizes.DEFAULT));
        } catch (MongoException e) {
            throw unreadable(mission, where(), e);
        } finally {
            if (!isStored) {
                client.close();
            }
        }
    }

    /** Returns the collection of a mission; empty if there is none. */
    public static Optional<String> collectionOf(MongoDatabase database, String mission) {
        return MissionCollections.candidates(mission).stream()
                .filter(name -> exists(database, name))
                .findFirst();
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
        if (failure instanceof MongoInterruptedException) {
            return RecordingInterruptedException.of(failure);
        }
        return new RecordingException(
                "Mission %s cannot be read from %s: %s. Check that MongoDB runs there and answers."
                        .formatted(mission, where, FailureText.of(failure)),
                failure);
    }

    private String where() {
        return "MongoDB at " + String.join(",", new ConnectionString(uri).getHosts()) + ", " + database;
    }

    /** Returns server and database without the password. */
    @Override
    public String toString() {
        return where();
    }
}
