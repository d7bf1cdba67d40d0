package io.furrow.bench.image;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Figures;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.ingest.image.ImageOptions;
import io.furrow.launcher.suite.RunDirectory;

/** {@code ./furrow bench images}. */
@Command(
        name = "images",
        description =
                "Stores images through the stage of ingest that moves them, and by a bare loop that decodes and writes "
                        + "them, in turns; prints images per second of each round and the ratio.")
public final class ImageBench extends Benchmark {
    @Command(name = "stage")
    private static final class StageOptions {
        @Mixin
        private final ImageOptions images = new ImageOptions();
    }

    @Option(names = "--images", paramLabel = "N", description = "Images of a round. " + DEFAULT)
    private int images = 2000;

    @Option(names = "--bytes", paramLabel = "BYTES", description = "Of an image, roughly. " + DEFAULT)
    private int bytes = 100_000;

    @Option(names = "--rounds", paramLabel = "N", description = "Rounds; the first warms up. " + DEFAULT)
    private int rounds = 4;

    @Option(names = "--parallelism", paramLabel = "N", description = "Of the stage. " + DEFAULT)
    private int parallelism = 1;

    @Override
    public Integer call() throws Exception {
        ImageMeasurement measurement = new ImageMeasurement(images, bytes);
        Figures figures = new Figures("%d images of %d bytes a round".formatted(images, measurement.bytes()));
        for (int round = 0; round < rounds; round++) {
            try (RunDirectory directory = RunDirectory.open(null)) {
                StageOptions options = new StageOptions();
                JobCommandLine.of(options)
                        .parseArgs("--images", directory.resolve("stage").toString());
                double bare = measurement.bareLoop(directory.resolve("bare"));
                double stage = measurement.stage(options.images, parallelism);
                say("round %d: %.0f/s".formatted(round, stage));
                figures.add(
                        "round",
                        round == 0 ? "warm-up" : Integer.toString(round),
                        "bare loop/s",
                        bare,
                        "stage/s",
                        stage,
                        "ratio",
                        stage / bare);
            }
        }
        print(figures);
        return 0;
    }
}
