package io.furrow.bench.replay;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.OutputOption;
import io.furrow.embedded.EmbeddedMongo;

/** {@code ./furrow bench replay}. */
@Command(
        name = "replay",
        description = {
            "Lets the job replay play made-up missions from MongoDB's stand-in in memory, at-least-once, and bare loops write the"
                    + " same records, by turns; prints by how much events are behind their schedule, or events per second.",
            "Exit code 0 means that every event was on its topic."
        })
public final class ReplayBench extends Benchmark {
    private static final int TIMED_PER_SECOND = 100;
    private static final int MANY_PER_SECOND = 20;

    @Option(names = "--timing", description = "One replay at speed 1, 100 events a second.")
    private boolean timing;

    @Option(
            names = "--many",
            paramLabel = "N",
            description = "So many replays at once at speed 1, 20 events a second each.")
    private int many;

    @Option(names = "--max", description = "One replay at speed max.")
    private boolean max;

    @Option(
            names = "--memory",
            description = "The heap that one replay at speed max holds, or with --many so many at speed 1.")
    private boolean memory;

    @Option(names = "--seek", description = "Seeks in a stored mission, without the job.")
    private boolean seek;

    @Option(names = "--seconds", paramLabel = "S", description = "How long missions last at speed 1. " + DEFAULT)
    private int seconds = 60;

    @Option(
            names = "--events",
            paramLabel = "N",
            description =
                    "Events of the mission at speed max and of that of seeks; each takes some 4 kB of heap. " + DEFAULT)
    private int events = 500_000;

    @Option(names = "--turns", paramLabel = "N", description = "Turns that count, after one that does not. " + DEFAULT)
    private int turns = 3;

    @Option(names = "--parallelism", paramLabel = "N", description = "Of the job. " + DEFAULT)
    private int parallelism = 2;

    @Option(
            names = "--checkpoint-millis",
            paramLabel = "MS",
            description = "Milliseconds between checkpoints. " + DEFAULT)
    private long checkpointMillis = 1000;

    @Mixin
    private final OutputOption output = new OutputOption();

    private final List<ArrayNode> all = new ArrayList<>();

    @Override
    public Integer call() throws Exception {
        try (Engines engines = Engines.in(null, out()).kafka(Map.of("log.message.timestamp.type", "LogAppendTime"))) {
            EmbeddedMongo mongo = engines.start("MongoDB", EmbeddedMongo::inMemory);
            ReplayCluster cluster = engines.flink(parallelism)
                    .start("replays", () -> new ReplayCluster(engines, mongo.uri(), checkpointMillis, parallelism));
            Engines.Job job = engines.submit("replay", cluster.job());
            boolean complete = measure(cluster);
            if (seek) {
                complete &= new SeekMeasurement(mongo.uri(), events, turns, this::say).run(this::show);
            }
            job.cancel();
            output.write(all);
            return complete ? 0 : 1;
        }
    }

    private boolean measure(ReplayCluster cluster) throws Exception {
        boolean complete = true;
        boolean any = timing || many > 0 || max || memory || seek;
        if (timing || !any) {
            complete &= timing(cluster, 1, TIMED_PER_SECOND).run(turns, this::show);
        }
        if (many > 0 && !memory) {
            complete &= timing(cluster, many, MANY_PER_SECOND).run(turns, this::show);
        }
        MaxMeasurement played = new MaxMeasurement(cluster, events, this::say);
        if (max) {
            complete &= played.run(turns, this::show);
        }
        if (memory) {
            long held = many > 0 ? timing(cluster, many, MANY_PER_SECOND).heldWhilePlayed() : played.heldWhilePlayed();
            say("held at most: %,d MiB".formatted(held));
        }
        return complete;
    }

    private TimingMeasurement timing(ReplayCluster cluster, int replays, int perSecond) {
        return new TimingMeasurement(cluster, replays, perSecond, seconds, this::say);
    }

    private void show(Figures figures) {
        print(figures);
        all.add(figures.json());
    }
}
