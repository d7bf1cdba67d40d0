package io.furrow.soak.ingest;

import java.nio.file.Path;
import java.util.concurrent.CountDownLatch;

import io.furrow.embedded.EmbeddedMongo;

/** Runs the stand-in for MongoDB as a process. */
public final class MongoStandIn {
    private MongoStandIn() {}

    /** Arguments: folder, port. Runs until it is killed. */
    public static void main(String... args) throws InterruptedException {
        EmbeddedMongo.start(Path.of(args[0]), Integer.parseInt(args[1]));
        new CountDownLatch(1).await();
    }
}
