package io.furrow.bench.component;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import picocli.CommandLine.Command;
import picocli.CommandLine.Parameters;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Figures;
import io.furrow.cli.option.CommandException;

/** {@code ./furrow bench compare}. */
@Command(
        name = "compare",
        description =
                "Compares two files of './furrow bench components': which components became faster or slower, and "
                        + "which differences are noise.")
public final class CompareBench extends Benchmark {
    @Parameters(index = "0", paramLabel = "BEFORE", description = "A file of './furrow bench components'.")
    private Path before;

    @Parameters(index = "1", paramLabel = "NOW", description = "Another.")
    private Path now;

    @Override
    public Integer call() throws Exception {
        ComponentResults base = existing(before);
        ComponentResults next = existing(now);
        Figures figures = new Figures("before: %s, now: %s; medians a second".formatted(base.commit(), next.commit()));
        for (Component component : Component.values()) {
            List<Component.Rates> former = base.of(component);
            List<Component.Rates> latter = next.of(component);
            if (!former.isEmpty() && !latter.isEmpty()) {
                Comparison comparison = new Comparison(former, latter);
                figures.add(
                        "component", component.title(),
                        "before/s", Comparison.median(former, Component.Rates::ours),
                        "now/s", Comparison.median(latter, Component.Rates::ours),
                        "peer before/s", Comparison.median(former, Component.Rates::peers),
                        "peer now/s", Comparison.median(latter, Component.Rates::peers),
                        "share before", Comparison.median(former, Component.Rates::share),
                        "share now", Comparison.median(latter, Component.Rates::share),
                        "ratio", comparison.ratio(),
                        "verdict", comparison.verdict());
            }
        }
        print(figures);
        return 0;
    }

    private static ComponentResults existing(Path file) throws IOException {
        if (!Files.isReadable(file)) {
            throw new CommandException(file + " cannot be read; './furrow bench components --results FILE' makes one");
        }
        return ComponentResults.in(file);
    }
}
