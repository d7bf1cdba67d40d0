package io.furrow.bench.command;

import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.image.ImageMeasurement;
import io.furrow.cli.option.HelpOption;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.ingest.image.ImageOptions;
import io.furrow.launcher.suite.RunDirectory;

/** {@code ./furrow bench images}. */
@Command(
        name = "images",
        abbreviateSynopsis = true,
        description =
                "Stores images through the stage of ingest that moves them, and by a bare loop that decodes and writes "
                        + "them, in turns; prints images per second of each round and the ratio.")
final class ImageBench implements Callable<Integer> {
    @Command(name = "stage")
    private static final class StageOptions {
        @Mixin
        private final ImageOptions images = new ImageOptions();
    }

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--images",
            paramLabel = "N",
            defaultValue = "2000",
            description = "Images of a round. Default: " + "${DEFAULT-VALUE}.")
    private int images;

    @Option(
            names = "--bytes",
            paramLabel = "BYTES",
            defaultValue = "100000",
            description = "Of an image, roughly. Default: " + "${DEFAULT-VALUE}.")
    private int bytes;

    @Option(
            names = "--rounds",
            paramLabel = "N",
            defaultValue = "4",
            description = "Rounds; the first warms up. Default: " + "${DEFAULT-VALUE}.")
    private int rounds;

    @Option(
            names = "--parallelism",
            paramLabel = "N",
            defaultValue = "1",
            description = "Of the stage. Default: " + "${DEFAULT-VALUE}.")
    private int parallelism;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        ImageMeasurement measurement = new ImageMeasurement(images, bytes);
        out.printf("%d images of %d bytes a round%n", images, measurement.bytes());
        for (int round = 0; round < rounds; round++) {
            try (RunDirectory directory = RunDirectory.open(null)) {
                Path folder = directory.resolve("stage");
                StageOptions options = new StageOptions();
                JobCommandLine.of(options).parseArgs("--images", folder.toString());
                double bare = measurement.bareLoop(directory.resolve("bare"));
                double stage = measurement.stage(options.images, parallelism);
                out.printf(
                        "%s  bare loop %.0f/s  stage %.0f/s  ratio %.2f%n",
                        round == 0 ? "warm-up" : "round " + round, bare, stage, stage / bare);
                out.flush();
            }
        }
        return 0;
    }
}
