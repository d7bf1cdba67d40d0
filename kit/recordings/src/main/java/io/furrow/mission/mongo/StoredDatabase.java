package io.furrow.mission.mongo;

import java.util.function.Supplier;

import com.mongodb.MongoException;
import com.mongodb.client.MongoDatabase;

import io.furrow.mission.RecordingException;
import io.furrow.model.text.FailureText;

/** The database of the stored missions, by the client that all in this process share. */
public class StoredDatabase implements AutoCloseable {
    private final SharedMongoClient client;
    private final MongoDatabase database;
    private final String where;

    /** Does not wait for the server. @throws IllegalArgumentException if the URI is none */
    protected StoredDatabase(MongoRecordings at) {
        this.client = SharedMongoClient.of(at.uri(), at.selectionTimeout());
        this.database = client.client().getDatabase(at.database());
        this.where = at.toString();
    }

    protected final MongoDatabase database() {
        return database;
    }

    /**
     * @param failed the beginning of a sentence that ends with where MongoDB is
     * @throws RecordingException if MongoDB cannot be asked now
     */
    protected final <T> T answer(String failed, Supplier<T> question) throws RecordingException {
        try {
            return question.get();
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
