package io.furrow.embedded;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;

import de.bwaldvogel.mongo.MongoBackend;
import de.bwaldvogel.mongo.MongoServer;
import de.bwaldvogel.mongo.ServerVersion;
import de.bwaldvogel.mongo.backend.h2.H2Backend;
import de.bwaldvogel.mongo.backend.memory.MemoryBackend;
import de.bwaldvogel.mongo.bson.Document;
import de.bwaldvogel.mongo.wire.message.MongoMessage;
import org.h2.mvstore.MVStore;

/**
 * A server in this JVM that speaks MongoDB's protocol, on 127.0.0.1, with its documents in one file unless said. What it has acknowledged
 * outlives the end of its process, also a sudden one; not that of the machine. It keeps no index but that of {@code _id} and
 * removes nothing by itself.
 */
public final class EmbeddedMongo implements AutoCloseable {
    private static final String HOST = "127.0.0.1";
    private static final int CACHE_MEGABYTES = 64;
    /** Room for what one bulk changes, so that the file is written once for it. */
    private static final int BUFFER_KILOBYTES = 16 * 1024;

    private final MongoServer server;
    private final int port;

    private EmbeddedMongo(MongoServer server, int port) {
        this.server = server;
        this.port = port;
    }

    /** A server on a free port that keeps its documents on the heap, several times their size, and forgets them. */
    public static EmbeddedMongo inMemory() {
        return serve(new MemoryBackend().version(ServerVersion.MONGO_5_0), FreePort.orFree(0));
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
                .autoCommitBufferSize(BUFFER_KILOBYTES)
                .open();
        return serve(new CommittingBackend(store), bound);
    }

    private static EmbeddedMongo serve(MongoBackend backend, int port) {
        MongoServer server = new MongoServer(backend);
        server.bind(HOST, port);
        return new EmbeddedMongo(server, port);
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
