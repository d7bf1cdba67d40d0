package io.furrow.embedded;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.locks.Lock;
import java.util.concurrent.locks.ReadWriteLock;
import java.util.concurrent.locks.ReentrantReadWriteLock;
import java.util.function.Supplier;

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
    /** Of documents as they are stored; on the heap they are three times as large. */
    private static final int CACHE_MEGABYTES = 16;

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
                .autoCommitDisabled()
                .autoCommitBufferSize(0)
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

    /**
     * Writes to its file before it answers, and while no other request is half done: a document and its entry in the index are
     * two changes, of which a sudden end may not leave one.
     */
    private static final class CommittingBackend extends H2Backend {
        private final ReadWriteLock whole = new ReentrantReadWriteLock(true);

        CommittingBackend(MVStore store) {
            super(store);
            version(ServerVersion.MONGO_5_0);
        }

        @Override
        public Document handleMessage(MongoMessage message) {
            Document answer = locked(whole.readLock(), () -> super.handleMessage(message));
            if (getMvStore().hasUnsavedChanges()) {
                locked(whole.writeLock(), () -> {
                    commit();
                    return null;
                });
            }
            return answer;
        }

        private static <T> T locked(Lock lock, Supplier<T> action) {
            lock.lock();
            try {
                return action.get();
            } finally {
                lock.unlock();
            }
        }
    }
}
