package io.furrow.embedded;

import java.io.FileDescriptor;
import java.io.FileOutputStream;
import java.io.OutputStream;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Collection;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.stream.Collectors;

import kafka.server.KafkaConfig;
import kafka.server.KafkaRaftServer;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.common.Uuid;
import org.apache.kafka.common.utils.Exit;
import org.apache.kafka.common.utils.Time;
import org.apache.kafka.metadata.storage.Formatter;

/**
 * One KRaft broker and controller in this JVM, on 127.0.0.1. An existing log directory is continued. Topics are created on first use with
 * {@value #PARTITIONS} partitions; records may have 16 MiB.
 */
public final class EmbeddedKafka implements AutoCloseable {
    /** Partitions of an automatically created topic. */
    public static final int PARTITIONS = 4;

    private static final String HOST = "127.0.0.1";
    private static final long POLL_INTERVAL_MILLIS = 20;
    private static final int MAX_RECORD_BYTES = 16 * 1024 * 1024;

    static {
        Exit.setExitProcedure((status, message) -> end(status, message, () -> System.exit(status)));
        Exit.setHaltProcedure((status, message) ->
                end(status, message, () -> Runtime.getRuntime().halt(status)));
    }

    private final KafkaRaftServer server;
    private final int port;

    private EmbeddedKafka(KafkaRaftServer server, int port) {
        this.server = server;
        this.port = port;
    }

    /** Starts a broker on a free port. */
    public static EmbeddedKafka start(Path directory) {
        return start(directory, 0);
    }

    /**
     * Starts and waits until it serves.
     *
     * @param directory the log directory; created if missing
     * @param port 0 for a free one
     */
    public static EmbeddedKafka start(Path directory, int port) {
        return start(directory, port, Map.of());
    }

    /** The same with broker settings that override those set here. */
    public static EmbeddedKafka start(Path directory, int port, Map<String, String> more) {
        int brokerPort = FreePort.orFree(port);
        Properties settings = asProperties(settings(directory, brokerPort, FreePort.otherThan(brokerPort)));
        settings.putAll(more);
        format(directory);
        KafkaRaftServer server = new KafkaRaftServer(new KafkaConfig(settings), Time.SYSTEM);
        server.startup();
        return new EmbeddedKafka(server, brokerPort);
    }

    public String bootstrapServers() {
        return HOST + ":" + port;
    }

    /** The settings of a client that connects to it. */
    public Properties client() {
        Properties client = new Properties();
        client.setProperty("bootstrap.servers", bootstrapServers());
        return client;
    }

    /**
     * Settings of a producer for newly created topics, with one request in flight: of two, the broker could refuse the first, whose
     * partition does not exist yet, and accept the second, and would then refuse the first forever (KAFKA-15591).
     */
    public Map<String, Object> producerSettings() {
        return Map.of("bootstrap.servers", bootstrapServers(), "max.in.flight.requests.per.connection", 1);
    }

    /** Creates topics and waits until the broker serves them, which is some time after the controller has created them. */
    public void createTopics(Collection<NewTopic> topics) {
        Set<String> names = topics.stream().map(NewTopic::name).collect(Collectors.toSet());
        try (Admin admin = Admin.create(Map.of("bootstrap.servers", bootstrapServers()))) {
            admin.createTopics(topics).all().get();
            while (!admin.listTopics().names().get().containsAll(names)) {
                Thread.sleep(POLL_INTERVAL_MILLIS);
            }
        } catch (ExecutionException e) {
            throw new IllegalStateException("cannot create the topics " + names, e.getCause());
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException("interrupted while the topics " + names + " were created", e);
        }
    }

    @Override
    public void close() {
        server.shutdown();
        server.awaitShutdown();
    }

    /** Kafka exits the process at a fatal fault. Its log may be lost then, so the cause is printed to standard error. */
    private static void end(int status, String message, Runnable ending) {
        try (PrintStream error = new PrintStream(new FileOutputStream(FileDescriptor.err))) {
            String why = message == null ? "" : ": " + message;
            new IllegalStateException("Kafka ends this process with status " + status + why).printStackTrace(error);
        }
        ending.run();
    }

    private static void format(Path directory) {
        try {
            Files.createDirectories(directory);
            new Formatter()
                    .setPrintStream(new PrintStream(OutputStream.nullOutputStream()))
                    .setNodeId(1)
                    .setClusterId(clusterId(directory))
                    .addDirectory(directory.toString())
                    .setMetadataLogDirectory(directory.toString())
                    .setControllerListenerName("CONTROLLER")
                    .setIgnoreFormatted(true)
                    .run();
        } catch (Exception e) { // the formatter declares no narrower type
            throw new IllegalStateException("cannot prepare Kafka's log directory " + directory, e);
        }
    }

    /** The cluster id of an earlier broker, because the formatter refuses a directory of another cluster. */
    private static String clusterId(Path directory) throws java.io.IOException {
        Path meta = directory.resolve("meta.properties");
        if (!Files.exists(meta)) {
            return Uuid.randomUuid().toString();
        }
        Properties existing = new Properties();
        try (var reader = Files.newBufferedReader(meta)) {
            existing.load(reader);
        }
        return existing.getProperty("cluster.id");
    }

    private static Map<String, Object> settings(Path directory, int port, int controllerPort) {
        return Map.ofEntries(
                Map.entry("process.roles", "broker,controller"),
                Map.entry("node.id", 1),
                Map.entry("controller.quorum.voters", "1@" + HOST + ":" + controllerPort),
                Map.entry(
                        "listeners",
                        "PLAINTEXT://" + HOST + ":" + port + ",CONTROLLER://" + HOST + ":" + controllerPort),
                Map.entry("advertised.listeners", "PLAINTEXT://" + HOST + ":" + port),
                Map.entry("controller.listener.names", "CONTROLLER"),
                Map.entry("inter.broker.listener.name", "PLAINTEXT"),
                Map.entry("listener.security.protocol.map", "PLAINTEXT:PLAINTEXT,CONTROLLER:PLAINTEXT"),
                Map.entry("log.dirs", directory.toString()),
                Map.entry("num.partitions", PARTITIONS),
                Map.entry("message.max.bytes", MAX_RECORD_BYTES),
                // There is no replica: a power cut loses the last second at most.
                Map.entry("log.flush.interval.ms", 1_000),
                Map.entry("log.flush.scheduler.interval.ms", 1_000),
                Map.entry("offsets.topic.num.partitions", PARTITIONS),
                Map.entry("offsets.topic.replication.factor", 1),
                // A single node loses and regains its own leadership at each start. A load begun before may then be
                // taken for that of the new state, and groups get old offsets; with small reads it notices and stops.
                Map.entry("offsets.load.buffer.size", 64 * 1024),
                // How long the broker waits for the markers of a transaction before it refuses the first batch of the
                // next.
                Map.entry("add.partitions.to.txn.retry.backoff.max.ms", 10_000),
                Map.entry("transaction.state.log.num.partitions", PARTITIONS),
                Map.entry("transaction.state.log.replication.factor", 1),
                Map.entry("transaction.state.log.min.isr", 1),
                Map.entry("share.coordinator.state.topic.replication.factor", 1),
                Map.entry("share.coordinator.state.topic.min.isr", 1),
                // The defaults are for a dedicated machine.
                Map.entry("num.network.threads", 1),
                Map.entry("num.io.threads", 4),
                Map.entry("background.threads", 2),
                Map.entry("group.coordinator.threads", 1),
                Map.entry("log.cleaner.dedupe.buffer.size", 8 * 1024 * 1024),
                // Otherwise a new group waits three seconds for further members.
                Map.entry("group.initial.rebalance.delay.ms", 0));
    }

    private static Properties asProperties(Map<String, Object> settings) {
        Properties properties = new Properties();
        properties.putAll(settings.entrySet().stream()
                .collect(Collectors.toMap(
                        Map.Entry::getKey, entry -> entry.getValue().toString())));
        return properties;
    }
}
