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
 * Opens clients of MongoDB.
 *
 * @param uri a connection string; its timeouts and write concern override the defaults here
 */
public record MongoAccess(String uri, Waits waits) implements Serializable {
    /**
     * How long documents are retried.
     *
     * @param unavailable while the server is unavailable
     * @param unknown while the server rejects them for an unknown reason
     */
    public record Waits(Duration unavailable, Duration unknown) implements Serializable {
        /** Returns the same timeout for both. */
        public static Waits of(Duration timeout) {
            return new Waits(timeout, timeout);
        }
    }

    /** The database of all missions. */
    public static final String DATABASE = "persistence";

    /** How long a command waits for an unavailable server. */
    static final Duration SELECTION_TIMEOUT = Duration.ofSeconds(5);

    private static final int CONNECT_SECONDS = 5;
    private static final int ANSWER_SECONDS = 60;

    /**
     * Opens a client without waiting for the server.
     *
     * @throws IllegalArgumentException if the URI is invalid
     */
    public MongoClient open() {
        return open(uri, SELECTION_TIMEOUT);
    }

    /** @param selectionTimeout how long a command waits for an unavailable server, unless the URI sets it */
    public static MongoClient open(String uri, Duration selectionTimeout) {
        ConnectionString connection = new ConnectionString(uri);
        MongoClientSettings.Builder settings = MongoClientSettings.builder()
                .applicationName("furrow")
                // Acknowledged documents must be on the disks of a majority, because a checkpoint does not send them
                // again.
                .writeConcern(WriteConcern.MAJORITY.withJournal(true))
                .applyToClusterSettings(
                        it -> it.serverSelectionTimeout(selectionTimeout.toMillis(), TimeUnit.MILLISECONDS))
                .applyToSocketSettings(it -> it.connectTimeout(CONNECT_SECONDS, TimeUnit.SECONDS)
                        .readTimeout(ANSWER_SECONDS, TimeUnit.SECONDS))
                .applyConnectionString(connection);
        return MongoClients.create(settings.build());
    }

    /**
     * Returns what is wrong with a URI without printing it, because it may contain a password.
     *
     * @param uri of an option; one that still begins with {@code @} names a file that cannot be read
     */
    public static String fault(String uri, IllegalArgumentException failure) {
        return uri.startsWith("@") ? uri.substring(1) + " cannot be read" : failure.getMessage();
    }

    /** Returns the hosts without the password. */
    @Override
    public String toString() {
        return String.join(",", new ConnectionString(uri).getHosts());
    }
}
