package io.furrow.bench.command;

import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.bench.whole.Checkout;
import io.furrow.bench.whole.Part;
import io.furrow.bench.whole.WholeMeasurement;
import io.furrow.bench.whole.WholeResults;
import io.furrow.cli.option.HelpOption;

/** {@code ./furrow bench whole}. */
@Command(
        name = "whole",
        abbreviateSynopsis = true,
        description =
                "Measures what the whole suite costs beside an older commit of this repository, in turns: with nothing to do, the"
                        + " demonstration farm, 125 and 625 messages of 1 kB a second. A turn takes some 12 minutes; one that was"
                        + " interrupted goes on where it was.")
final class WholeBench implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

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

    @Option(
            names = "--turns",
            paramLabel = "N",
            defaultValue = "1",
            description = "Turns; the table has their medians. Default: ${DEFAULT-VALUE}.")
    private int turns;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            defaultValue = "20",
            description = "Seconds of each part that do not count. Default: ${DEFAULT-VALUE}.")
    private long warmup;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "40",
            description = "Seconds of each part that count. Default: ${DEFAULT-VALUE}.")
    private long seconds;

    @Option(
            names = "--results",
            paramLabel = "FILE",
            defaultValue = "target/whole/results.csv",
            description =
                    "Grows with each figure; what it already holds is not measured again. Default: ${DEFAULT-VALUE}.")
    private Path results;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        if (!against.matches("[0-9a-f]{7,40}")) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--against takes the id of a commit, for instance 83ca898, not '" + against + "'");
        }
        PrintWriter out = spec.commandLine().getOut();
        Checkout here = Checkout.here();
        Checkout other = here.at(against);
        Files.createDirectories(results.toAbsolutePath().getParent());
        WholeResults known = WholeResults.in(results);
        WholeMeasurement measurement = new WholeMeasurement(Duration.ofSeconds(warmup), Duration.ofSeconds(seconds));
        for (int turn = 1; turn <= turns; turn++) {
            for (Part part : parts) {
                // Who comes first changes with each turn.
                for (Checkout checkout : turn % 2 == 1 ? List.of(here, other) : List.of(other, here)) {
                    if (!known.has(turn, part, checkout)) {
                        out.printf("  turn %d of %d: %s, %s …%n", turn, turns, part, checkout.name());
                        out.flush();
                        WholeMeasurement.Result result = measurement.run(checkout, part);
                        known.add(turn, part, checkout, result.figures());
                        print(out, result);
                    }
                }
            }
        }
        known.print(out, here, other);
        return 0;
    }

    /** Where the processor time went. */
    private static void print(PrintWriter out, WholeMeasurement.Result result) {
        result.roles().entrySet().stream()
                .sorted(Map.Entry.<String, Double>comparingByValue().reversed())
                .forEach(role -> out.printf(Locale.ROOT, "      %-32s %6.3f cores%n", role.getKey(), role.getValue()));
        out.printf(Locale.ROOT, "      %-32s %6.0f/s%n", "switches between threads", result.switchesPerSecond());
        out.flush();
    }
}
