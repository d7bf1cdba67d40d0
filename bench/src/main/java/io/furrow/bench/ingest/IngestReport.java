package io.furrow.bench.ingest;

import java.util.List;
import java.util.function.ToDoubleFunction;

import com.fasterxml.jackson.databind.ObjectMapper;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.bench.frame.Figures;
import io.furrow.flink.job.Delivery;

/** The runs of a measurement, their medians, and the medians of their ratios to the copying runs of the same turn. */
record IngestReport(Plan plan, List<Run> runs) {
    private static final ObjectMapper JSON = new ObjectMapper();

    /**
     * The parameters of the measurement.
     *
     * @param records of the input topic, all of which every turn reads
     * @param partitions of the input topic
     * @param bytes of a record's value, approximately
     * @param devices that report, each once a second of event time
     * @param missions of the devices
     * @param parallelism of every job
     * @param checkpointIntervalMillis of every job
     */
    record Plan(
            int records,
            int partitions,
            int bytes,
            int devices,
            int missions,
            int parallelism,
            long checkpointIntervalMillis) {}

    /**
     * The result of one job in one turn.
     *
     * @param turn from 1 on; the runs of one turn are compared
     * @param recordsPerSecond input records, by when their output could be read
     * @param processorMicros processor time of this JVM per record, brokers included
     * @param stateBytes of a checkpoint after all input; 0 for a job without state
     * @param missing records missing on the topics of domain and missions; negative for duplicates
     */
    record Run(
            ComparedJob job,
            Delivery delivery,
            int turn,
            double recordsPerSecond,
            double processorMicros,
            long stateBytes,
            long missing) {}

    private List<Run> of(Delivery delivery, ComparedJob job) {
        return runs.stream()
                .filter(run -> run.delivery() == delivery && run.job() == job)
                .toList();
    }

    /** Records per second. */
    double median(Delivery delivery, ComparedJob job) {
        return Figures.median(of(delivery, job), Run::recordsPerSecond);
    }

    /** Ratio of the records per second to those of another job in the same turn; NaN without that. */
    double ratio(Delivery delivery, ComparedJob job, ComparedJob other) {
        return ratio(delivery, job, other, Run::recordsPerSecond);
    }

    private double ratio(Delivery delivery, ComparedJob job, ComparedJob other, ToDoubleFunction<Run> figure) {
        return Figures.median(
                of(delivery, job),
                run -> of(delivery, other).stream()
                        .filter(one -> one.turn() == run.turn())
                        .mapToDouble(one -> figure.applyAsDouble(run) / figure.applyAsDouble(one))
                        .findFirst()
                        .orElse(Double.NaN));
    }

    /** Whether every run wrote every record the expected number of times. */
    boolean isComplete() {
        return runs.stream().allMatch(run -> run.missing() == 0);
    }

    Figures figures() {
        Figures figures = new Figures(
                "%n%,d records of %,d bytes on %d partitions about %,d devices on %d missions, parallelism %d, a checkpoint every %d ms"
                        .formatted(
                                plan.records,
                                plan.bytes,
                                plan.partitions,
                                plan.devices,
                                plan.missions,
                                plan.parallelism,
                                plan.checkpointIntervalMillis));
        for (Delivery delivery : runs.stream().map(Run::delivery).distinct().toList()) {
            for (ComparedJob job : runs.stream().map(Run::job).distinct().toList()) {
                List<Run> its = of(delivery, job);
                figures.add(
                        "delivery", IngestMeasurement.words(delivery),
                        "job", job.title(),
                        "records/s", median(delivery, job),
                        "of two topics", ratio(delivery, job, ComparedJob.COPY_TWICE),
                        "of one topic", ratio(delivery, job, ComparedJob.COPY_ONCE),
                        "µs each", Figures.median(its, Run::processorMicros),
                        "µs of two topics",
                                ratio(delivery, job, ComparedJob.COPY_TWICE, run -> 1 / run.processorMicros()),
                        "state, B/device", Figures.median(its, Run::stateBytes) / plan.devices,
                        "missing", its.stream().mapToLong(Run::missing).sum());
            }
        }
        return figures;
    }

    /** Every figure of every run. */
    ObjectNode json() {
        ObjectNode json = JSON.valueToTree(plan);
        ArrayNode all = json.putArray("runs");
        for (Run run : runs) {
            ObjectNode one = JSON.valueToTree(run);
            all.add(one.put("job", run.job.title()).put("delivery", IngestMeasurement.words(run.delivery)));
        }
        return json;
    }
}
