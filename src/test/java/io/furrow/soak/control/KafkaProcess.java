package io.furrow.soak.control;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.process.Ports;

/** A broker as a process, on the same port and directory after each start. */
public final class KafkaProcess implements AutoCloseable {
    private static final Duration START_TIMEOUT = Duration.ofSeconds(60);

    private final int port = FreePort.orFree(0);
    private final JavaProcess process;

    public KafkaProcess(Path folder) {
        process = new JavaProcess(
                folder.resolve("kafka.out"),
                List.of("-Xmx512m", "-Dfurrow.log=" + folder.resolve("kafka.log")),
                KafkaProcess.class.getName(),
                List.of(folder.resolve("kafka").toString(), Integer.toString(port)));
    }

    /** Runs until it is killed; arguments: directory and port. */
    public static void main(String... args) throws InterruptedException {
        EmbeddedKafka.start(Path.of(args[0]), Integer.parseInt(args[1]));
        Thread.currentThread().join();
    }

    public String bootstrapServers() {
        return "127.0.0.1:" + port;
    }

    /** Returns once it listens. */
    public void start() throws IOException {
        process.start();
        Until.isTrue("Kafka listens", START_TIMEOUT, () -> Ports.isListening(port));
    }

    void kill() throws InterruptedException {
        process.kill();
    }

    @Override
    public void close() {
        process.close();
    }
}
