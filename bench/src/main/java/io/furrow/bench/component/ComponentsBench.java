package io.furrow.bench.component;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.whole.Checkout;
import io.furrow.cli.option.CommandException;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow bench components}. */
@Command(
        name = "components",
        description =
                "Runs the benches of all components, each beside its peers, in short forms and in turns, and prints "
                        + "one table. An interrupted run continues. './furrow bench compare' compares two of its files.")
public final class ComponentsBench extends Benchmark {
    @Option(
            names = "--components",
            paramLabel = "NAME",
            split = ",",
            defaultValue = "SOURCE,SINK,INGEST,COLLISION,REPLAY",
            description = "What is measured: ${COMPLETION-CANDIDATES}. Default: all.")
    private List<Component> components;

    @Option(names = "--turns", paramLabel = "N", description = "Turns; the table has their medians. " + DEFAULT)
    private int turns = 5;

    @Option(
            names = "--results",
            paramLabel = "FILE",
            description = "Results; what it already contains of this commit is not measured again. " + DEFAULT)
    private Path results = Path.of("target/components.jsonl");

    @Override
    public Integer call() throws Exception {
        Checkout here = Checkout.here();
        Files.createDirectories(results.toAbsolutePath().getParent());
        ComponentResults known = ComponentResults.in(results);
        for (int turn = 1; turn <= turns; turn++) {
            for (Component component : components) {
                if (!known.has(here.name(), turn, component)) {
                    say("turn %d of %d: %s …".formatted(turn, turns, component.title()));
                    known.add(here.name(), turn, component, component.rates(output(here, component)));
                }
            }
        }
        print(figures(known));
        return 0;
    }

    /** Runs the bench in its own process, because heap and compiled code of one would affect the next. */
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

    private static Figures figures(ComponentResults known) {
        Figures figures = new Figures("medians of " + known.commit());
        for (Component component : Component.values()) {
            List<Component.Rates> its = known.of(component);
            if (!its.isEmpty()) {
                double ours = Comparison.median(its, Component.Rates::ours);
                double peers = Comparison.median(its, Component.Rates::peers);
                double share = Comparison.median(its, Component.Rates::share);
                add(figures, component.title(), ours, peers, share, component.peer());
                component.others(its).forEach((peer, median) -> {
                    String name = median.isNaN() ? peer + ": not measured, see bench/README.md" : peer;
                    add(figures, "", null, median, ours / median, name);
                });
            }
        }
        return figures;
    }

    private static void add(Figures figures, String title, Double ours, double peers, double share, String peer) {
        figures.add("component", title, "a second", ours, "its peer", peers, "share", share, "peer", peer);
    }
}
