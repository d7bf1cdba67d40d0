package io.furrow.bench.notifications;

import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.ToDoubleFunction;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.bench.http.HttpLoadPlan;

/**
 * The figures of several runs and the median of each.
 *
 * @param journal where the journal was, and on what kind of file system
 */
public record NotificationReport(HttpLoadPlan plan, String journal, List<NotificationRun> runs) {
    private static final String LINE =
            "%-7s %9.0f %9.0f %8.1f %8.1f %8.1f %8s %8s %8s %9.0f %9.0f %9.0f %7.2f %7.2f %7.2f%n";
    private static final String HEAD = "%-7s %9s %9s %8s %8s %8s %8s %8s %8s %9s %9s %9s %7s %7s %7s%n";

    /** The median of one figure; of an even number of runs the upper one. */
    public double median(ToDoubleFunction<NotificationRun> figure) {
        double[] sorted = runs.stream().mapToDouble(figure).sorted().toArray();
        return sorted[sorted.length / 2];
    }

    /** Acknowledged notifications that are not in Kafka, of all runs. */
    public long missing() {
        return runs.stream().mapToLong(NotificationRun::missing).sum();
    }

    public void print(PrintWriter out) {
        out.println(title());
        out.println("journal in " + journal);
        out.printf(
                HEAD,
                "",
                "answered",
                "in Kafka",
                "p50",
                "p99",
                "max",
                "missing",
                "repeats",
                "failed",
                "bare",
                "bare",
                "bare",
                "share",
                "share",
                "share");
        out.printf(
                HEAD,
                "run",
                "per s",
                "per s",
                "ms",
                "ms",
                "ms",
                "",
                "",
                "",
                "server/s",
                "bridge/s",
                "prod./s",
                "server",
                "bridge",
                "prod.");
        for (int i = 0; i < runs.size(); i++) {
            NotificationRun run = runs.get(i);
            line(
                    out,
                    Integer.toString(i + 1),
                    figure -> figure.applyAsDouble(run),
                    run.missing(),
                    run.repeats(),
                    run.load().refused() + run.load().broken());
        }
        line(
                out,
                "median",
                this::median,
                missing(),
                total(NotificationRun::repeats),
                total(run -> run.load().refused() + run.load().broken()));
        out.println("bare server: p99 %.1f ms; it gets the same load"
                .formatted(median(run -> run.bareServer().millis(99))));
        out.println();
        out.println("processor time in microseconds per notification, median");
        for (String part : parts()) {
            out.printf(Locale.ROOT, "  %-24s %7.1f%n", part, median(run -> run.cpuMicros(part)));
        }
        out.printf(Locale.ROOT, "  %-24s %7.1f%n", "all", median(NotificationRun::cpuMicros));
        out.flush();
    }

    /** How to get one figure out of a run, or its median out of all. */
    private interface Figures {
        double get(ToDoubleFunction<NotificationRun> figure);
    }

    private static void line(PrintWriter out, String name, Figures of, long missing, long repeats, long failed) {
        out.printf(
                Locale.ROOT,
                LINE,
                name,
                of.get(run -> run.load().perSecond()),
                of.get(NotificationRun::inKafkaPerSecond),
                of.get(run -> run.load().millis(50)),
                of.get(run -> run.load().millis(99)),
                of.get(run -> run.load().millis(100)),
                missing,
                repeats,
                failed,
                of.get(run -> run.bareServer().perSecond()),
                of.get(run -> run.bareBridge().perSecond()),
                of.get(NotificationRun::producerPerSecond),
                of.get(NotificationRun::ofBareServer),
                of.get(NotificationRun::ofBareBridge),
                of.get(NotificationRun::ofProducer));
    }

    private long total(java.util.function.ToLongFunction<NotificationRun> count) {
        return runs.stream().mapToLong(count).sum();
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
    public ObjectNode json() {
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

    private ObjectNode figures(ObjectNode json, Figures of) {
        json.put("answeredPerSecond", of.get(run -> run.load().perSecond()));
        json.put("inKafkaPerSecond", of.get(NotificationRun::inKafkaPerSecond));
        json.put("p50Millis", of.get(run -> run.load().millis(50)));
        json.put("p99Millis", of.get(run -> run.load().millis(99)));
        json.put("maxMillis", of.get(run -> run.load().millis(100)));
        json.put("bareServerPerSecond", of.get(run -> run.bareServer().perSecond()));
        json.put("bareServerP99Millis", of.get(run -> run.bareServer().millis(99)));
        json.put("bareBridgePerSecond", of.get(run -> run.bareBridge().perSecond()));
        json.put("bareProducerPerSecond", of.get(NotificationRun::producerPerSecond));
        json.put("shareOfBareServer", of.get(NotificationRun::ofBareServer));
        json.put("shareOfBareBridge", of.get(NotificationRun::ofBareBridge));
        json.put("shareOfBareProducer", of.get(NotificationRun::ofProducer));
        ObjectNode cpu = json.putObject("cpuMicrosPerNotification");
        parts().forEach(part -> cpu.put(part, of.get(run -> run.cpuMicros(part))));
        return json;
    }
}
