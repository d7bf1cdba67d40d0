package io.furrow.bench.ingest;

import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;
import java.util.function.ToDoubleFunction;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.flink.job.Delivery;

/** The runs of a measurement, their medians, and the medians of their ratios to the runs of the same turn that only copy. */
public record IngestReport(IngestPlan plan, List<IngestRun> runs) {
    private static final String ROW = "%-13s  %-34s %10s %14s %13s %10s %14s %15s %8s%n";

    /** Records per second. */
    public double median(Delivery delivery, ComparedJob peer) {
        return median(delivery, peer, IngestRun::recordsPerSecond);
    }

    /** Records per second to those of another job in the same turn; NaN if that had none. */
    public double ratio(Delivery delivery, ComparedJob peer, ComparedJob other) {
        return ratio(delivery, peer, other, IngestRun::recordsPerSecond);
    }

    /** The same of records per second of processor time, which other work on the machine disturbs less. */
    public double processorRatio(Delivery delivery, ComparedJob peer, ComparedJob other) {
        return ratio(delivery, peer, other, run -> 1 / run.processorMicros());
    }

    private double ratio(Delivery delivery, ComparedJob peer, ComparedJob other, ToDoubleFunction<IngestRun> figure) {
        return median(
                delivery,
                peer,
                run -> runs.stream()
                        .filter(one -> one.turn() == run.turn() && one.delivery() == delivery && one.peer() == other)
                        .mapToDouble(one -> figure.applyAsDouble(run) / figure.applyAsDouble(one))
                        .findFirst()
                        .orElse(Double.NaN));
    }

    /** Of an even number the upper one. */
    private double median(Delivery delivery, ComparedJob peer, ToDoubleFunction<IngestRun> figure) {
        double[] sorted = runs.stream()
                .filter(run -> run.delivery() == delivery && run.peer() == peer)
                .mapToDouble(figure)
                .sorted()
                .toArray();
        return sorted.length == 0 ? Double.NaN : sorted[sorted.length / 2];
    }

    /** Whether every record was there as often as it should be, in every run. */
    public boolean isComplete() {
        return runs.stream().allMatch(run -> run.missing() == 0);
    }

    public void print(PrintWriter out) {
        out.printf(
                Locale.ROOT,
                "%n%,d records of %,d bytes on %d partitions about %,d devices on %d missions, parallelism %d, a checkpoint every %d ms%n",
                plan.records(),
                plan.bytes(),
                plan.partitions(),
                plan.devices(),
                plan.missions(),
                plan.parallelism(),
                plan.checkpointInterval().toMillis());
        out.printf(
                ROW,
                "delivery",
                "job",
                "records/s",
                "of two topics",
                "of one topic",
                "µs each",
                "of two topics",
                "state, B/device",
                "missing");
        runs.stream()
                .map(IngestRun::delivery)
                .distinct()
                .forEach(delivery -> runs.stream()
                        .map(IngestRun::peer)
                        .distinct()
                        .forEach(peer -> out.printf(
                                ROW,
                                IngestMeasurement.words(delivery),
                                peer.title(),
                                "%,.0f".formatted(median(delivery, peer)),
                                "%.2f".formatted(ratio(delivery, peer, ComparedJob.COPY_TWICE)),
                                "%.2f".formatted(ratio(delivery, peer, ComparedJob.COPY_ONCE)),
                                "%.1f".formatted(median(delivery, peer, IngestRun::processorMicros)),
                                "%.2f".formatted(processorRatio(delivery, peer, ComparedJob.COPY_TWICE)),
                                "%,.0f".formatted(median(delivery, peer, IngestRun::stateBytes) / plan.devices()),
                                runs.stream()
                                        .filter(run -> run.delivery() == delivery && run.peer() == peer)
                                        .mapToLong(IngestRun::missing)
                                        .sum())));
        out.flush();
    }

    /** Every figure of every run. */
    public ObjectNode json() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("records", plan.records())
                .put("partitions", plan.partitions())
                .put("bytes", plan.bytes())
                .put("devices", plan.devices())
                .put("missions", plan.missions())
                .put("parallelism", plan.parallelism())
                .put("checkpointIntervalMillis", plan.checkpointInterval().toMillis());
        for (IngestRun run : runs) {
            json.withArray("runs")
                    .addObject()
                    .put("job", run.peer().title())
                    .put("delivery", IngestMeasurement.words(run.delivery()))
                    .put("turn", run.turn())
                    .put("recordsPerSecond", run.recordsPerSecond())
                    .put("processorMicros", run.processorMicros())
                    .put("stateBytes", run.stateBytes())
                    .put("missing", run.missing());
        }
        return json;
    }
}
