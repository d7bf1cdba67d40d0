package io.furrow.bench.whole;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Figures;

/** {@code ./furrow bench whole}. */
@Command(
        name = "whole",
        description = "Measures what the whole suite costs beside an older commit of this repository, in turns: with "
                + "nothing to do, the demonstration farm, 125 and 625 messages of 1 kB a second. A turn takes some 25 "
                + "minutes; an interrupted run continues.")
public final class WholeBench extends Benchmark {
    @Option(
            names = "--against",
            paramLabel = "COMMIT",
            required = true,
            description = "Built in a worktree below target/whole, which stays there.")
    private String against;

    @Option(
            names = "--parts",
            paramLabel = "PART",
            split = ",",
            defaultValue = "IDLE,DEMO,LOAD_125,LOAD_625",
            description = "What is measured: ${COMPLETION-CANDIDATES}. Default: all.")
    private List<Part> parts;

    @Option(names = "--turns", paramLabel = "N", description = "Turns; the table has their medians. " + DEFAULT)
    private int turns = 1;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            description = "Seconds of each part that do not count; in the first minute the JVM compiles. " + DEFAULT)
    private long warmup = 120;

    @Option(names = "--seconds", paramLabel = "S", description = "Seconds of each part that count. " + DEFAULT)
    private long seconds = 40;

    @Option(
            names = "--results",
            paramLabel = "FILE",
            description =
                    "Grows with each figure; what it already holds is not measured again. Another file for another --warmup. "
                            + DEFAULT)
    private Path results = Path.of("target/whole/results.csv");

    @Override
    public Integer call() throws Exception {
        if (!against.matches("[0-9a-f]{7,40}")) {
            throw new ParameterException(
                    spec().commandLine(),
                    "--against takes the id of a commit, for instance 83ca898, not '" + against + "'");
        }
        Checkout here = Checkout.here();
        Checkout other = here.at(against);
        Files.createDirectories(results.toAbsolutePath().getParent());
        WholeResults known = WholeResults.in(results);
        WholeMeasurement measurement = new WholeMeasurement(Duration.ofSeconds(warmup), Duration.ofSeconds(seconds));
        for (int turn = 1; turn <= turns; turn++) {
            for (Part part : parts) {
                // The order changes with each turn.
                for (Checkout checkout : turn % 2 == 1 ? List.of(here, other) : List.of(other, here)) {
                    if (!known.has(turn, part, checkout)) {
                        say("turn %d of %d: %s, %s …".formatted(turn, turns, part, checkout.name()));
                        WholeMeasurement.Result result = measurement.run(checkout, part);
                        known.add(turn, part, checkout, result.figures());
                        print(roles(result));
                    }
                }
            }
        }
        print(known.figures(here, other));
        return 0;
    }

    /** Processor time by role. */
    private static Figures roles(WholeMeasurement.Result result) {
        Figures figures = new Figures("%.0f switches between threads a second".formatted(result.switchesPerSecond()));
        result.roles().entrySet().stream()
                .sorted(Map.Entry.<String, Double>comparingByValue().reversed())
                .forEach(role -> figures.add("threads", role.getKey(), "cores", "%.3f".formatted(role.getValue())));
        return figures;
    }
}
