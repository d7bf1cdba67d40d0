package io.furrow.mission.mongo;

import java.io.Serializable;
import java.time.Duration;
import java.util.concurrent.TimeUnit;

import com.mongodb.ConnectionString;
import com.mongodb.MongoClientSettings;
import com.mongodb.WriteConcern;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;

/**
 * How MongoDB is reached.
 *
 * @param uri a connection string; what it says of timeouts and of the write concern goes before what is set here
 */
public record MongoAccess(String uri, Waits waits) implements Serializable {
    /**
     * How long documents are tried again.
     *
     * @param away while the server is unavailable
     * @param unknown where it does not take them for a reason that may or may not pass
     */
    public record Waits(Duration away, Duration unknown) implements Serializable {
        /** The same for both. */
        public static Waits of(Duration timeout) {
            return new Waits(timeout, timeout);
        }
    }

    /** The database of all missions. */
    public static final String DATABASE = "persistence";

    /** How long a command waits for a server that is unavailable. */
    static final Duration SELECTION_TIMEOUT = Duration.ofSeconds(5);

    private static final int CONNECT_SECONDS = 5;
    private static final int ANSWER_SECONDS = 60;

    /**
     * Does not wait for the server.
     *
     * @throws IllegalArgumentException if the URI is none
     */
    public MongoClient open() {
        return open(uri, SELECTION_TIMEOUT);
    }

    /** @param selectionTimeout how long a command waits for a server that is unavailable, unless the URI says so */
    public static MongoClient open(String uri, Duration selectionTimeout) {
        ConnectionString given = new ConnectionString(uri);
        MongoClientSettings.Builder settings = MongoClientSettings.builder()
                .applicationName("furrow")
                // Acknowledged means on the disk of most members: a checkpoint skips what was acknowledged.
                .writeConcern(WriteConcern.MAJORITY.withJournal(true))
                .applyToClusterSettings(
                        it -> it.serverSelectionTimeout(selectionTimeout.toMillis(), TimeUnit.MILLISECONDS))
                .applyToSocketSettings(it -> it.connectTimeout(CONNECT_SECONDS, TimeUnit.SECONDS)
                        .readTimeout(ANSWER_SECONDS, TimeUnit.SECONDS))
                .applyConnectionString(given);
        return MongoClients.create(settings.build());
    }

    /**
     * Says what is wrong with a URI, without it: it may hold a password.
     *
     * @param uri of an option; one that still begins with {@code @} is a file that could not be read
     */
    public static String fault(String uri, IllegalArgumentException refusal) {
        return uri.startsWith("@") ? uri.substring(1) + " cannot be read" : refusal.getMessage();
    }

    /** Holds no password. */
    @Override
    public String toString() {
        return String.join(",", new ConnectionString(uri).getHosts());
    }
}
