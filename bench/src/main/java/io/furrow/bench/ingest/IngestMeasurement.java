package io.furrow.bench.ingest;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.stream.IntStream;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;

import io.furrow.flink.job.Delivery;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Runs the job ingest and jobs that only copy bytes on the same topic, in turns, and reports the throughput of each.
 */
public final class IngestMeasurement {
    private static final int PARTITIONS = 4;
    private static final short REPLICAS = 1;
    private static final long POLL_INTERVAL_MS = 20;
    private static final Duration TIMEOUT = Duration.ofMinutes(5);

    private final IngestPlan plan;
    private final Properties kafka;
    private final Path checkpoints;
    private final String mongo;
    private final Jobs flink;
    private final Consumer<String> progress;

    /** A Flink cluster. */
    public interface Jobs {
        Running start(String name, StreamExecutionEnvironment job) throws Exception;
    }

    /** A job on it. */
    public interface Running {
        /** Returns when it has ended. */
        void cancel() throws Exception;
    }

    /**
     * Where it is measured.
     *
     * @param mongo URI of the server in which the job ingest keeps missions; null for none
     */
    public record Cluster(Properties kafka, Jobs flink, Path checkpoints, String mongo) {
        public Cluster(Properties kafka, Jobs flink, Path checkpoints) {
            this(kafka, flink, checkpoints, null);
        }
    }

    /** @param progress is reported after each job's turn */
    public IngestMeasurement(IngestPlan plan, Cluster cluster, Consumer<String> progress) {
        this.plan = plan;
        this.kafka = cluster.kafka();
        this.flink = cluster.flink();
        this.checkpoints = cluster.checkpoints();
        this.mongo = cluster.mongo();
        this.progress = progress;
    }

    /** One turn of all jobs does not count, because the JVM is cold. */
    public List<IngestRun> run(List<ComparedJob> peers, List<Delivery> deliveries) throws Exception {
        fill();
        List<IngestRun> counted = new ArrayList<>();
        for (int turn = 0; turn <= plan.turns(); turn++) {
            for (Delivery delivery : deliveries) {
                for (ComparedJob peer : peers) {
                    IngestRun run = run(peer, delivery, turn);
                    progress.accept("%s  %-13s  %-34s %,9.0f records/s %7.1f µs"
                            .formatted(
                                    turn == 0 ? "warm-up" : "turn " + turn + " ",
                                    words(delivery),
                                    peer.title(),
                                    run.recordsPerSecond(),
                                    run.processorMicros()));
                    if (turn > 0) {
                        counted.add(run);
                    }
                }
            }
        }
        return counted;
    }

    private void fill() throws InterruptedException, ExecutionException, UnreadableException {
        progress.accept("%,d records of %,d bytes to %s".formatted(plan.records(), plan.bytes(), Topics.RAW));
        try (Admin admin = Admin.create(kafka)) {
            admin.createTopics(List.of(new NewTopic(Topics.RAW, plan.partitions(), REPLICAS)))
                    .all()
                    .get();
        }
        new ReportedEntities(plan)
                .writeTo(Topics.RAW, kafka, written -> progress.accept("%,d written".formatted(written)));
    }

    private IngestRun run(ComparedJob peer, Delivery delivery, int turn) throws Exception {
        List<String> topics = new ArrayList<>(List.of(Topics.realtime(ReportedEntities.DOMAIN)));
        topics.addAll(missionTopics());
        long expected = (long) plan.records() * peer.writes();
        String name = "%s-%s-%d".formatted(peer, delivery, turn).toLowerCase(Locale.ROOT);
        try (WrittenTopics written =
                new WrittenTopics(kafka, topics, PARTITIONS, List.of(Topics.LATEST, Topics.CATALOG))) {
            Throughput throughput = new Throughput(expected);
            Running job = flink.start(name, job(name, peer, delivery));
            try {
                long end = System.nanoTime() + TIMEOUT.toNanos();
                while (!throughput.areAll()) {
                    if (System.nanoTime() > end) {
                        throw new IllegalStateException("%s: %d of %d records after %d s"
                                .formatted(name, written.readable(), expected, TIMEOUT.toSeconds()));
                    }
                    TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
                    throughput.add(written.readable());
                }
                long missing = expected - written.counted(expected, TIMEOUT);
                long stateBytes = turn == 0 || peer != ComparedJob.INGEST
                        ? 0
                        : Checkpoints.bytesOfNext(checkpoints.resolve(name), TIMEOUT);
                Throughput.Pace pace = throughput.pace();
                return new IngestRun(
                        peer,
                        delivery,
                        turn,
                        pace.perSecond() / peer.writes(),
                        pace.processorMicrosEach() * peer.writes(),
                        stateBytes,
                        missing);
            } finally {
                job.cancel();
                written.delete();
            }
        }
    }

    /** Under a name of its own each reads from the beginning and has its own transactions. */
    private StreamExecutionEnvironment job(String name, ComparedJob peer, Delivery delivery) {
        List<String> args = new ArrayList<>(peer.options());
        args.addAll(List.of("--bootstrap-servers", kafka.getProperty("bootstrap.servers")));
        args.addAll(List.of("--delivery", words(delivery)));
        args.addAll(List.of("--parallelism", Integer.toString(plan.parallelism())));
        args.addAll(List.of("--checkpoint-interval", plan.checkpointInterval().toMillis() + "ms"));
        args.addAll(
                List.of("--checkpoint-dir", checkpoints.resolve(name).toUri().toString()));
        if (peer == ComparedJob.INGEST && mongo != null) {
            args.addAll(List.of("--mongo", mongo));
        }
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).setCommandName(name).parseArgs(args.toArray(String[]::new));
        return switch (peer) {
            case COPY_ONCE -> CopyJob.assemble(options, Topics.realtime(ReportedEntities.DOMAIN), List.of());
            case COPY_TWICE -> CopyJob.assemble(options, Topics.realtime(ReportedEntities.DOMAIN), missionTopics());
            case ROUTES, INGEST -> IngestJob.assemble(options);
        };
    }

    private List<String> missionTopics() {
        return IntStream.range(0, plan.missions())
                .mapToObj(number -> Topics.realtime(ReportedEntities.DOMAIN, ReportedEntities.mission(number)))
                .toList();
    }

    static String words(Delivery delivery) {
        return delivery.name().toLowerCase(Locale.ROOT).replace('_', '-');
    }
}
