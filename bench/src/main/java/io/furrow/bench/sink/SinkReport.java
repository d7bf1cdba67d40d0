package io.furrow.bench.sink;

import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** The runs of one kind and their median. */
public record SinkReport(String title, List<SinkRun> runs) {
    private static final String HEAD = "%-7s %10s %10s %10s %8s %12s%n";

    /** Updates per second; of an even number of runs the upper median. */
    public double median() {
        double[] sorted =
                runs.stream().mapToDouble(SinkRun::updatesPerSecond).sorted().toArray();
        return sorted[sorted.length / 2];
    }

    /** Entities whose newest state did not come, of all runs. */
    public long missing() {
        return runs.stream().mapToLong(SinkRun::missing).sum();
    }

    public void print(PrintWriter out) {
        SinkPlan plan = runs.get(0).plan();
        out.printf(
                Locale.ROOT,
                "%s: %d records of %d bytes about %d entities%n",
                title,
                plan.records(),
                plan.payloadBytes(),
                plan.entities());
        out.printf(HEAD, "run", "updates/s", "entities", "requests", "missing", "bare server");
        for (int i = 0; i < runs.size(); i++) {
            SinkRun run = runs.get(i);
            out.printf(
                    Locale.ROOT,
                    "%-7d %10.0f %10d %10d %8d %12.0f%n",
                    i + 1,
                    run.updatesPerSecond(),
                    run.entities(),
                    run.requests(),
                    run.missing(),
                    run.bareEntitiesPerSecond());
        }
        out.printf(Locale.ROOT, "%-7s %10.0f%n%n", "median", median());
        out.flush();
    }

    /** Every figure of every run. */
    public ObjectNode json() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("title", title).put("medianUpdatesPerSecond", median());
        for (SinkRun run : runs) {
            json.withArray("runs")
                    .addObject()
                    .put("records", run.plan().records())
                    .put("entitiesInTopic", run.plan().entities())
                    .put("updatesPerSecond", run.updatesPerSecond())
                    .put("entitiesWritten", run.entities())
                    .put("requests", run.requests())
                    .put("missing", run.missing())
                    .put("bareServerEntitiesPerSecond", run.bareEntitiesPerSecond());
        }
        return json;
    }
}
