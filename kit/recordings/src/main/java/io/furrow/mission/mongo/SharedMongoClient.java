package io.furrow.mission.mongo;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;

import com.mongodb.client.MongoClient;

/** A reference to the client that all users of a server in this process share; it is closed with the last reference. */
public final class SharedMongoClient implements AutoCloseable {
    private static final Map<Server, References> OPEN = new HashMap<>();

    private final Server server;
    private final MongoClient client;
    private boolean closed;

    private record Server(String uri, Duration selectionTimeout) {}

    private record References(MongoClient client, int count) {}

    private SharedMongoClient(Server server, MongoClient client) {
        this.server = server;
        this.client = client;
    }

    /**
     * Returns a reference without waiting for the server.
     *
     * @throws IllegalArgumentException if the URI is invalid
     */
    public static SharedMongoClient of(String uri, Duration selectionTimeout) {
        Server server = new Server(uri, selectionTimeout);
        synchronized (OPEN) {
            References references = OPEN.get(server);
            MongoClient client = references == null ? MongoAccess.open(uri, selectionTimeout) : references.client();
            OPEN.put(server, new References(client, references == null ? 1 : references.count() + 1));
            return new SharedMongoClient(server, client);
        }
    }

    public MongoClient client() {
        return client;
    }

    /** Returns the number of open clients. */
    static int open() {
        synchronized (OPEN) {
            return OPEN.size();
        }
    }

    @Override
    public void close() {
        synchronized (OPEN) {
            if (closed) {
                return;
            }
            closed = true;
            References references = OPEN.get(server);
            if (references.count() > 1) {
                OPEN.put(server, new References(client, references.count() - 1));
                return;
            }
            OPEN.remove(server);
        }
        client.close();
    }
}
