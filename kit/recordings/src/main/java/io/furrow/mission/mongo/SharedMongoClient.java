package io.furrow.mission.mongo;

import java.time.Duration;
import java.util.HashMap;
import java.util.Map;

import com.mongodb.client.MongoClient;

/** A use of the client that all in this process share who ask the same server; the client is closed with its last use. */
public final class SharedMongoClient implements AutoCloseable {
    private static final Map<Server, Uses> OPEN = new HashMap<>();

    private final Server server;
    private final MongoClient client;
    private boolean closed;

    private record Server(String uri, Duration selectionTimeout) {}

    private record Uses(MongoClient client, int number) {}

    private SharedMongoClient(Server server, MongoClient client) {
        this.server = server;
        this.client = client;
    }

    /**
     * Does not wait for the server.
     *
     * @throws IllegalArgumentException if the URI is none
     */
    public static SharedMongoClient of(String uri, Duration selectionTimeout) {
        Server server = new Server(uri, selectionTimeout);
        synchronized (OPEN) {
            Uses uses = OPEN.get(server);
            MongoClient client = uses == null ? MongoAccess.open(uri, selectionTimeout) : uses.client();
            OPEN.put(server, new Uses(client, uses == null ? 1 : uses.number() + 1));
            return new SharedMongoClient(server, client);
        }
    }

    public MongoClient client() {
        return client;
    }

    /** How many servers somebody uses. */
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
            Uses uses = OPEN.get(server);
            if (uses.number() > 1) {
                OPEN.put(server, new Uses(client, uses.number() - 1));
                return;
            }
            OPEN.remove(server);
        }
        client.close();
    }
}
