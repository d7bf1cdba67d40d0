package io.furrow.bench.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.component.Comparison;
import io.furrow.bench.component.Component;
import io.furrow.bench.component.Component.Rates;
import io.furrow.bench.component.ComponentResults;
import io.furrow.bench.whole.Checkout;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow bench components}. */
@Command(
        name = "components",
        abbreviateSynopsis = true,
        description =
                "Runs the benches of all components, each beside its peers, in short forms and in turns, and prints one table. One that was"
                        + " interrupted goes on where it was. './furrow bench compare' compares two of its files.")
final class ComponentsBench implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--components",
            paramLabel = "NAME",
            split = ",",
            defaultValue = "SOURCE,SINK,INGEST,COLLISION,REPLAY",
            description = "What is measured: ${COMPLETION-CANDIDATES}. Default: all.")
    private List<Component> components;

    @Option(
            names = "--turns",
            paramLabel = "N",
            defaultValue = "5",
            description = "Turns; the table has their medians. Default: ${DEFAULT-VALUE}.")
    private int turns;

    @Option(
            names = "--results",
            paramLabel = "FILE",
            defaultValue = "target/components.jsonl",
            description =
                    "Grows with each figure; what it already holds of this commit is not measured again. Default: ${DEFAULT-VALUE}.")
    private Path results;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        Checkout here = Checkout.here();
        Files.createDirectories(results.toAbsolutePath().getParent());
        ComponentResults known = ComponentResults.in(results);
        for (int turn = 1; turn <= turns; turn++) {
            for (Component component : components) {
                if (!known.has(here.name(), turn, component)) {
                    out.printf("  turn %d of %d: %s …%n", turn, turns, component.title());
                    out.flush();
                    known.add(here.name(), turn, component, component.rates(output(here, component)));
                }
            }
        }
        print(out, known);
        return 0;
    }

    /** In a process of its own, as heaps and compiled code of one would help or hinder the next. */
    private static JsonNode output(Checkout here, Component component) throws IOException, InterruptedException {
        Path output = Files.createTempFile("furrow-component", ".json");
        try {
            List<String> words =
                    new ArrayList<>(List.of(here.home().resolve("furrow").toString(), "bench"));
            words.addAll(component.words());
            words.addAll(List.of("--output", output.toString()));
            int status = new ProcessBuilder(words)
                    .directory(here.home().toFile())
                    .redirectOutput(ProcessBuilder.Redirect.DISCARD)
                    .redirectError(ProcessBuilder.Redirect.INHERIT)
                    .start()
                    .waitFor();
            if (status != 0) {
                throw new CommandException(
                        "%s ended with %d; run it to see why".formatted(String.join(" ", words), status));
            }
            return NgsiJson.mapper().readTree(output.toFile());
        } finally {
            Files.deleteIfExists(output);
        }
    }

    private static void print(PrintWriter out, ComponentResults known) {
        out.printf(Locale.ROOT, "%-38s %12s %12s %8s  %s%n", known.commit(), "a second", "its peer", "share", "peer");
        for (Component component : Component.values()) {
            List<Rates> its = known.of(component);
            if (!its.isEmpty()) {
                out.printf(
                        Locale.ROOT,
                        "%-38s %,12.0f %,12.0f %8.2f  %s%n",
                        component.title(),
                        Comparison.median(its, Rates::ours),
                        Comparison.median(its, Rates::peers),
                        Comparison.median(its, Rates::share),
                        component.peer());
                component
                        .others(its)
                        .forEach((peer, median) -> out.printf(
                                Locale.ROOT,
                                "%-38s %12s %,12.0f %8.2f  %s%n",
                                "",
                                "",
                                median,
                                Comparison.median(its, Rates::ours) / median,
                                median.isNaN() ? peer + ": not measured, see bench/README.md" : peer));
            }
        }
        out.flush();
    }

    /** The body of {@code ./furrow bench compare}. */
    static void compare(PrintWriter out, Path before, Path now) throws IOException {
        ComponentResults base = existing(before);
        ComponentResults next = existing(now);
        out.printf(
                Locale.ROOT,
                "%-38s %12s %12s %12s %12s %8s %8s %7s%n%-38s %12s %12s %12s %12s %8s %8s %7s%n",
                "",
                base.commit(),
                next.commit(),
                "its peer",
                "its peer",
                "share",
                "share",
                "",
                "a second; medians",
                "before",
                "now",
                "before",
                "now",
                "before",
                "now",
                "ratio");
        for (Component component : Component.values()) {
            List<Rates> former = base.of(component);
            List<Rates> latter = next.of(component);
            if (!former.isEmpty() && !latter.isEmpty()) {
                Comparison comparison = new Comparison(former, latter);
                out.printf(
                        Locale.ROOT,
                        "%-38s %,12.0f %,12.0f %,12.0f %,12.0f %8.2f %8.2f %7.2f  %s%n",
                        component.title(),
                        Comparison.median(former, Rates::ours),
                        Comparison.median(latter, Rates::ours),
                        Comparison.median(former, Rates::peers),
                        Comparison.median(latter, Rates::peers),
                        Comparison.median(former, Rates::share),
                        Comparison.median(latter, Rates::share),
                        comparison.ratio(),
                        comparison.verdict());
            }
        }
        out.flush();
    }

    private static ComponentResults existing(Path file) throws IOException {
        if (!Files.isReadable(file)) {
            throw new CommandException(file + " cannot be read; './furrow bench components --results FILE' makes one");
        }
        return ComponentResults.in(file);
    }
}
