package io.furrow.bench.notifications;

import java.io.PrintWriter;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.ToDoubleFunction;
import java.util.function.ToLongFunction;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.bench.frame.Figures;
import io.furrow.bench.http.HttpLoad;

/**
 * The figures of several runs and the median of each.
 *
 * @param journal location of the journal, and the kind of file system
 */
record NotificationReport(HttpLoad.Plan plan, String journal, List<Run> runs) {
    private static final List<Column> COLUMNS = List.of(
            new Column("answered/s", "answeredPerSecond", run -> run.load().perSecond()),
            new Column("in Kafka/s", "inKafkaPerSecond", Run::inKafkaPerSecond),
            new Column("p50 ms", "p50Millis", run -> run.load().millis(50)),
            new Column("p99 ms", "p99Millis", run -> run.load().millis(99)),
            new Column("max ms", "maxMillis", run -> run.load().millis(100)),
            new Column(
                    "bare server/s",
                    "bareServerPerSecond",
                    run -> run.bareServer().perSecond()),
            new Column(
                    "its p99 ms", "bareServerP99Millis", run -> run.bareServer().millis(99)),
            new Column(
                    "bare bridge/s",
                    "bareBridgePerSecond",
                    run -> run.bareBridge().perSecond()),
            new Column("bare prod./s", "bareProducerPerSecond", Run::producerPerSecond),
            new Column("share: server", "shareOfBareServer", Run::ofBareServer),
            new Column("bridge", "shareOfBareBridge", Run::ofBareBridge),
            new Column("prod.", "shareOfBareProducer", Run::ofProducer));

    /** A figure with its column title and its member of JSON. */
    private record Column(String head, String member, ToDoubleFunction<Run> figure) {}

    /** The median of one figure; of an even number of runs the upper one. */
    double median(ToDoubleFunction<Run> figure) {
        return Figures.median(runs, figure);
    }

    /** Acknowledged notifications missing in Kafka, of all runs. */
    long missing() {
        return total(Run::missing);
    }

    private long total(ToLongFunction<Run> count) {
        return runs.stream().mapToLong(count).sum();
    }

    void print(PrintWriter out) {
        Figures figures = new Figures(title() + System.lineSeparator() + "journal in " + journal);
        for (int i = 0; i < runs.size(); i++) {
            Run run = runs.get(i);
            row(
                    figures,
                    Integer.toString(i + 1),
                    figure -> figure.applyAsDouble(run),
                    counts -> counts.applyAsLong(run));
        }
        row(figures, "median", this::median, this::total);
        figures.print(out);
        Figures parts = new Figures("processor time in microseconds per notification, median");
        parts().forEach(part -> parts.add("part", part, "us", median(run -> run.cpuMicros(part))));
        parts.add("part", "all", "us", median(Run::cpuMicros)).print(out);
    }

    /** Returns one figure of a run, or its median of all runs. */
    private interface Of {
        double get(ToDoubleFunction<Run> figure);
    }

    private static void row(Figures figures, String name, Of of, ToLongFunction<ToLongFunction<Run>> count) {
        List<Object> row = new ArrayList<>(List.of("run", name));
        COLUMNS.forEach(column -> row.addAll(List.of(column.head, of.get(column.figure))));
        row.addAll(List.of("missing", count.applyAsLong(Run::missing)));
        row.addAll(List.of("repeats", count.applyAsLong(Run::repeats)));
        row.addAll(List.of(
                "failed",
                count.applyAsLong(run -> run.load().refused() + run.load().broken())));
        figures.add(row.toArray());
    }

    private Set<String> parts() {
        Set<String> parts = new TreeSet<>();
        runs.forEach(run -> parts.addAll(run.cpuNanos().keySet()));
        return parts;
    }

    private String title() {
        return "Notifications of %d bytes over %d %s, %s, %d s a run"
                .formatted(
                        plan.payloadBytes(),
                        plan.connections(),
                        plan.newConnections() ? "connections at a time, a new one for each" : "kept connections",
                        plan.rate() == 0 ? "as fast as they are answered" : plan.rate() + " per second due",
                        plan.duration().toSeconds());
    }

    /** Every figure of every run. */
    ObjectNode json() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("title", title()).put("journal", journal);
        json.put("connections", plan.connections()).put("newConnections", plan.newConnections());
        json.put("rate", plan.rate()).put("payloadBytes", plan.payloadBytes());
        json.put("seconds", plan.duration().toSeconds());
        runs.forEach(run -> figures(json.withArray("runs").addObject(), figure -> figure.applyAsDouble(run))
                .put("missing", run.missing())
                .put("repeats", run.repeats())
                .put("refused", run.load().refused())
                .put("broken", run.load().broken()));
        figures(json.putObject("median"), this::median);
        return json;
    }

    private ObjectNode figures(ObjectNode json, Of of) {
        COLUMNS.forEach(column -> json.put(column.member, of.get(column.figure)));
        ObjectNode cpu = json.putObject("cpuMicrosPerNotification");
        parts().forEach(part -> cpu.put(part, of.get(run -> run.cpuMicros(part))));
        return json;
    }

    /**
     * One run of the source, and the measurements beside it.
     *
     * @param load the senders' result
     * @param inKafkaPerSecond acknowledged notifications by the time until a reader of the topic had the last of them
     * @param missing acknowledged notifications that are not in the topic
     * @param repeats repeated records of a notification in the topic
     * @param cpuNanos processor time by part
     * @param bareServer the same load on a server that only answers
     * @param bareBridge the same load on a server that answers when Kafka has it
     * @param producerPerSecond similar records by a bare producer
     */
    record Run(
            HttpLoad.Result load,
            double inKafkaPerSecond,
            long missing,
            long repeats,
            Map<String, Long> cpuNanos,
            HttpLoad.Result bareServer,
            HttpLoad.Result bareBridge,
            double producerPerSecond) {
        /** Notifications per second that were acknowledged and in Kafka. */
        double perSecond() {
            return Math.min(load.perSecond(), inKafkaPerSecond);
        }

        double ofBareServer() {
            return perSecond() / bareServer.perSecond();
        }

        double ofBareBridge() {
            return perSecond() / bareBridge.perSecond();
        }

        double ofProducer() {
            return perSecond() / producerPerSecond;
        }

        /** Microseconds of processor time of a part per notification. */
        double cpuMicros(String part) {
            return load.answered() == 0 ? 0 : cpuNanos.getOrDefault(part, 0L) / 1000.0 / load.answered();
        }

        double cpuMicros() {
            return cpuNanos.keySet().stream().mapToDouble(this::cpuMicros).sum();
        }
    }
}
