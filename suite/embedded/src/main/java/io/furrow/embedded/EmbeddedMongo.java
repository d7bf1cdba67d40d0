package io.furrow.embedded;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import de.bwaldvogel.mongo.MongoBackend;
import de.bwaldvogel.mongo.MongoServer;
import de.bwaldvogel.mongo.MongoVersion;
import de.bwaldvogel.mongo.ServerVersion;
import de.bwaldvogel.mongo.backend.memory.MemoryBackend;

/**
 * A server in this JVM that speaks MongoDB's protocol, on 127.0.0.1, with its documents in one file unless in memory. Acknowledged writes
 * survive the end of the process, also a sudden one, but not that of the machine. It maintains indexes of unique keys and of one date; it
 * has no retention.
 */
public final class EmbeddedMongo implements AutoCloseable {
    /** Claims the protocol of 5.0. The library's constant claims that of 4.2, which current drivers refuse. */
    static final MongoVersion VERSION = new MongoVersion() {
        @Override
        public List<Integer> getVersionArray() {
            return ServerVersion.MONGO_5_0.getVersionArray();
        }

        @Override
        public int getWireVersion() {
            return 13;
        }
    };

    private static final String HOST = "127.0.0.1";

    private final MongoServer server;
    private final int port;

    private EmbeddedMongo(MongoServer server, int port) {
        this.server = server;
        this.port = port;
    }

    /** Starts a server on a free port that holds its documents on the heap, at several times their size, and loses them. */
    public static EmbeddedMongo inMemory() {
        return serve(new MemoryBackend().version(VERSION), FreePort.orFree(0));
    }

    /** Starts a server on a free port. */
    public static EmbeddedMongo start(Path directory) {
        return start(directory, 0);
    }

    /**
     * Starts and waits until it serves.
     *
     * @param directory for its file; created if missing, continued if it has one
     * @param port 0 for a free one
     */
    public static EmbeddedMongo start(Path directory, int port) {
        int bound = FreePort.orFree(port);
        try {
            Files.createDirectories(directory);
        } catch (IOException e) {
            throw new UncheckedIOException("cannot make MongoDB's directory " + directory, e);
        }
        return serve(MongoFile.open(directory.resolve("mongo.mv")), bound);
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
}
