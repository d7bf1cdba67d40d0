package io.furrow.bench.frame;

import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;

import org.apache.flink.api.common.JobID;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamGraph;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;

import io.furrow.embedded.EmbeddedConnect;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.Connectors;
import io.furrow.launcher.suite.RunDirectory;

/**
 * Engines of a benchmark in this JVM, on free ports and with their data in one directory. They stop in reverse order; a temporary
 * directory is deleted then.
 */
public final class Engines implements AutoCloseable {
    private static final long STOP_SECONDS = 30;

    private final RunDirectory directory;
    private final Closeables parts;
    private final Progress progress;
    private final Properties client = new Properties();
    private EmbeddedFlink flink;

    /** A running job. */
    public interface Job {
        /** Returns when it has ended. */
        void cancel() throws Exception;
    }

    private Engines(RunDirectory directory, Progress progress) {
        this.directory = directory;
        this.progress = progress;
        parts = directory.closingFirst(new Closeables());
        LogFile.writeTo(directory.resolve("furrow.log"));
    }

    /** Starts without engines. @param data null for a temporary directory */
    public static Engines in(Path data, PrintWriter out) {
        return new Engines(RunDirectory.open(data), new Progress(out));
    }

    public Engines kafka() throws Exception {
        return kafka(Map.of());
    }

    /** @param settings of the broker in addition to the defaults */
    public Engines kafka(Map<String, String> settings) throws Exception {
        EmbeddedKafka kafka = start("Kafka", () -> EmbeddedKafka.start(folder("kafka"), 0, settings));
        client.setProperty("bootstrap.servers", kafka.bootstrapServers());
        return this;
    }

    public Engines flink(int slots) throws Exception {
        flink = start("Flink", () -> EmbeddedFlink.start(slots, 0));
        return this;
    }

    /** A Connect worker with our connectors. @param worker settings in addition to the defaults */
    public Connectors connect(Map<String, String> worker) throws Exception {
        Path plugins = Path.of(System.getProperty("furrow.plugins"));
        return new Connectors(start(
                        "Kafka Connect",
                        () -> EmbeddedConnect.start(bootstrapServers(), plugins, 0, new HashMap<>(worker)))
                .uri());
    }

    public <T extends AutoCloseable> T start(String name, Callable<T> part) throws Exception {
        return parts.add(name, progress.step(name, part));
    }

    public Path folder(String name) {
        return directory.resolve(name);
    }

    public String bootstrapServers() {
        return client.getProperty("bootstrap.servers");
    }

    /** Settings of any Kafka client. */
    public Properties client() {
        Properties copy = new Properties();
        copy.putAll(client);
        return copy;
    }

    /** The options of a job on these engines, with its checkpoints in a folder of its name. @param more arguments */
    public <T extends JobOptions> T options(String name, T options, String... more) {
        String checkpoints = folder("checkpoints").resolve(name).toUri().toString();
        List<String> words =
                new ArrayList<>(List.of("--bootstrap-servers", bootstrapServers(), "--checkpoint-dir", checkpoints));
        words.addAll(List.of(more));
        JobCommandLine.of(options).setCommandName(name).parseArgs(words.toArray(String[]::new));
        return options;
    }

    public Job submit(String name, StreamExecutionEnvironment job) {
        StreamGraph graph = job.getStreamGraph();
        graph.setJobName(name);
        JobID id = flink.submit(graph);
        return () -> {
            flink.cluster().cancelJob(id).get(STOP_SECONDS, TimeUnit.SECONDS);
            flink.cluster().requestJobResult(id).get(STOP_SECONDS, TimeUnit.SECONDS);
        };
    }

    /** Creates topics with one replica. @param partitions of each */
    public static void makeTopics(Properties client, int partitions, Map<String, String> settings, String... topics)
            throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(client)) {
            admin.createTopics(Stream.of(topics)
                            .map(topic -> new NewTopic(topic, partitions, (short) 1).configs(settings))
                            .toList())
                    .all()
                    .get();
        }
    }

    @Override
    public void close() {
        parts.close();
        directory.close();
    }
}
