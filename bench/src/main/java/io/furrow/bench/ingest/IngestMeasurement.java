package io.furrow.bench.ingest;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.stream.IntStream;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.Admin;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicReader;
import io.furrow.flink.job.Delivery;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;
import io.furrow.model.topic.Topics;

/** Runs the job ingest and jobs that only copy bytes on the same topic alternately, and reports the throughput of each. */
final class IngestMeasurement {
    private static final int PARTITIONS = 4;
    private static final long POLL_INTERVAL_MS = 20;
    private static final Duration POLL = Duration.ofMillis(100);
    private static final Duration TIMEOUT = Duration.ofMinutes(5);

    private final IngestReport.Plan plan;
    private final Engines engines;
    private final String mongo;
    private final Consumer<String> progress;

    /**
     * @param mongo URI of the server in which the job ingest stores missions; null for none
     * @param progress is called after each job's turn
     */
    IngestMeasurement(IngestReport.Plan plan, Engines engines, String mongo, Consumer<String> progress) {
        this.plan = plan;
        this.engines = engines;
        this.mongo = mongo;
        this.progress = progress;
    }

    /** One additional turn of all jobs warms up the JVM. */
    List<IngestReport.Run> run(List<ComparedJob> jobs, List<Delivery> deliveries, int turns) throws Exception {
        fill();
        List<IngestReport.Run> counted = new ArrayList<>();
        for (int turn = 0; turn <= turns; turn++) {
            for (Delivery delivery : deliveries) {
                for (ComparedJob job : jobs) {
                    IngestReport.Run run = run(job, delivery, turn);
                    progress.accept("%s  %-13s  %-34s %,9.0f records/s %7.1f µs"
                            .formatted(
                                    turn == 0 ? "warm-up" : "turn " + turn + " ",
                                    words(delivery),
                                    job.title(),
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

    private void fill() throws Exception {
        progress.accept("%,d records of %,d bytes to %s".formatted(plan.records(), plan.bytes(), Topics.RAW));
        Engines.makeTopics(engines.client(), plan.partitions(), Map.of(), Topics.RAW);
        new ReportedEntities(plan)
                .writeTo(Topics.RAW, engines.client(), written -> progress.accept("%,d written".formatted(written)));
    }

    private IngestReport.Run run(ComparedJob compared, Delivery delivery, int turn) throws Exception {
        List<String> topics = new ArrayList<>(List.of(Topics.realtime(ReportedEntities.DOMAIN)));
        topics.addAll(missionTopics());
        long expected = (long) plan.records() * compared.writes();
        String name = "%s-%s-%d".formatted(compared, delivery, turn).toLowerCase(Locale.ROOT);
        Engines.makeTopics(engines.client(), PARTITIONS, Map.of(), topics.toArray(String[]::new));
        try (TopicReader written = written(topics)) {
            Engines.Job job = engines.submit(name, job(name, compared, delivery));
            try {
                Throughput throughput = throughput(name, written, expected);
                long missing = expected - counted(written, expected);
                long stateBytes = turn == 0 || compared != ComparedJob.INGEST
                        ? 0
                        : Checkpoints.bytesOfNext(checkpoints(name), TIMEOUT);
                Throughput.Pace pace = throughput.pace();
                double perSecond = pace.perSecond() / compared.writes();
                double micros = pace.processorMicrosEach() * compared.writes();
                return new IngestReport.Run(compared, delivery, turn, perSecond, micros, stateBytes, missing);
            } finally {
                job.cancel();
                delete(topics);
            }
        }
    }

    private TopicReader written(List<String> topics) {
        Map<String, String> settings = new HashMap<>(TopicReader.COMMITTED);
        settings.put("max.poll.records", "5000");
        return TopicReader.fromBeginning(engines.client(), settings, topics.toArray(String[]::new));
    }

    /**
     * Polls the end offsets of the topics until all records are written: reading them would take processor time from the
     * job. With exactly-once there are some more for transaction markers: a few per partition and checkpoint.
     */
    private Throughput throughput(String name, TopicReader written, long expected) throws InterruptedException {
        Throughput throughput = new Throughput(expected);
        long end = System.nanoTime() + TIMEOUT.toNanos();
        while (!throughput.areAll()) {
            if (System.nanoTime() > end) {
                throw new IllegalStateException("%s: %d of %d records after %d s"
                        .formatted(name, written.end(), expected, TIMEOUT.toSeconds()));
            }
            TimeUnit.MILLISECONDS.sleep(POLL_INTERVAL_MS);
            throughput.add(written.end());
        }
        return throughput;
    }

    /** Reads and counts them all. */
    private static long counted(TopicReader written, long expected) {
        long records = 0;
        long end = System.nanoTime() + TIMEOUT.toNanos();
        while ((records < expected || !written.isAtEnd()) && System.nanoTime() < end) {
            records += written.poll(POLL).count();
        }
        return records;
    }

    /** Also deletes topics that the job may have created beside them. */
    private void delete(List<String> topics) throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(engines.client())) {
            Set<String> there = new HashSet<>(topics);
            there.addAll(List.of(Topics.LATEST, Topics.CATALOG));
            there.retainAll(admin.listTopics().names().get());
            admin.deleteTopics(there).all().get();
        }
    }

    private Path checkpoints(String name) {
        return engines.folder("checkpoints").resolve(name);
    }

    /** Each job has its own name, and so reads from the beginning and has its own transactions. */
    private StreamExecutionEnvironment job(String name, ComparedJob compared, Delivery delivery) {
        List<String> words = new ArrayList<>(compared.options());
        words.addAll(List.of("--delivery", words(delivery)));
        words.addAll(List.of("--parallelism", Integer.toString(plan.parallelism())));
        words.addAll(List.of("--checkpoint-interval", plan.checkpointIntervalMillis() + "ms"));
        if (compared == ComparedJob.INGEST && mongo != null) {
            words.addAll(List.of("--mongo", mongo));
        }
        IngestOptions options = engines.options(name, new IngestOptions(), words.toArray(String[]::new));
        return switch (compared) {
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
