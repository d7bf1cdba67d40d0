package io.furrow.embedded;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;

import de.bwaldvogel.mongo.MongoServer;
import de.bwaldvogel.mongo.ServerVersion;
import de.bwaldvogel.mongo.backend.h2.H2Backend;
import de.bwaldvogel.mongo.bson.Document;
import de.bwaldvogel.mongo.wire.message.MongoMessage;
import org.h2.mvstore.MVStore;

/**
 * A server in this JVM that speaks MongoDB's protocol, on 127.0.0.1, with its documents in one file. What it has acknowledged
 * outlives the end of its process, also a sudden one; not that of the machine. It keeps no index but that of {@code _id} and
 * removes nothing by itself.
 */
public final class EmbeddedMongo implements AutoCloseable {
    private static final String HOST = "127.0.0.1";
    private static final int CACHE_MEGABYTES = 16;

    private final MongoServer server;
    private final int port;

    private EmbeddedMongo(MongoServer server, int port) {
        this.server = server;
        this.port = port;
    }

    /** A server on a free port. */
    public static EmbeddedMongo start(Path directory) {
        return start(directory, 0);
    }

    /**
     * Starts and waits until it serves.
     *
     * @param directory for its file; made where it is missing, continued where an earlier server left one
     * @param port 0 for a free one
     */
    public static EmbeddedMongo start(Path directory, int port) {
        int bound = FreePort.orFree(port);
        try {
            Files.createDirectories(directory);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot make MongoDB's directory " + directory, e);
        }
        MVStore store = new MVStore.Builder()
                .fileName(directory.resolve("mongo.mv").toString())
                .cacheSize(CACHE_MEGABYTES)
                .open();
        MongoServer server = new MongoServer(new CommittingBackend(store));
        server.bind(HOST, bound);
        return new EmbeddedMongo(server, bound);
    }

    /** {@code mongodb://127.0.0.1:<port>}. */
    public String uri() {
        return "mongodb://" + HOST + ":" + port;
    }

    @Override
    public void close() {
        server.shutdownNow();
    }

    /** Writes to its file before it answers; by itself the store would do so within a second. */
    private static final class CommittingBackend extends H2Backend {
        CommittingBackend(MVStore store) {
            super(store);
            version(ServerVersion.MONGO_5_0);
        }

        @Override
        public Document handleMessage(MongoMessage message) {
            Document answer = super.handleMessage(message);
            if (getMvStore().hasUnsavedChanges()) {
                commit();
            }
            return answer;
        }
    }
}
