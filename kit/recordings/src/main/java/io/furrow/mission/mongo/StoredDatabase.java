package io.furrow.mission.mongo;

import java.util.function.Supplier;

import com.mongodb.MongoException;
import com.mongodb.client.MongoDatabase;

import io.furrow.mission.RecordingException;
import io.furrow.model.text.FailureText;

/** Base of classes that query the database of missions with the shared client. */
public class StoredDatabase implements AutoCloseable {
    private final SharedMongoClient client;
    private final MongoDatabase database;
    private final String where;

    /**
     * Opens the database without waiting for the server.
     *
     * @throws IllegalArgumentException if the URI is invalid
     */
    protected StoredDatabase(MongoRecordings recordings) {
        this.client = SharedMongoClient.of(recordings.uri(), recordings.selectionTimeout());
        this.database = client.client().getDatabase(recordings.database());
        this.where = recordings.toString();
    }

    protected final MongoDatabase database() {
        return database;
    }

    /**
     * Runs a query.
     *
     * @param failed beginning of the message of a failure; the address of MongoDB follows
     * @throws RecordingException if MongoDB is unavailable
     */
    protected final <T> T run(String failed, Supplier<T> query) throws RecordingException {
        try {
            return query.get();
        } catch (MongoException e) {
            throw new RecordingException(
                    "%s %s: %s. Check that MongoDB runs there and answers.".formatted(failed, where, FailureText.of(e)),
                    e);
        }
    }

    @Override
    public final void close() {
        client.close();
    }
}
