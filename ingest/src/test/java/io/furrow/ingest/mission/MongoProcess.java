package io.furrow.ingest.mission;

import java.io.IOException;
import java.nio.file.Path;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.process.TestProcess;

/** A MongoDB server in a process of its own, to be killed and started again on its data. */
final class MongoProcess implements AutoCloseable {
    private final Path directory;
    private final int port = FreePort.orFree(0);
    private Process process;

    MongoProcess(Path directory) throws IOException {
        this.directory = directory;
        start();
    }

    String uri() {
        return "mongodb://127.0.0.1:" + port;
    }

    /** SIGKILL: nothing can be put in order. */
    void kill() throws InterruptedException {
        process.destroyForcibly();
        process.waitFor(10, TimeUnit.SECONDS);
    }

    void start() throws IOException {
        process = TestProcess.java("-Xmx256m", MongoProcess.class, directory, port)
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.DISCARD)
                .start();
    }

    @Override
    public void close() {
        process.destroyForcibly();
    }

    /** The process itself; ends when it is killed. */
    public static void main(String... args) throws InterruptedException {
        EmbeddedMongo.start(Path.of(args[0]), Integer.parseInt(args[1]));
        new CountDownLatch(1).await();
    }
}
