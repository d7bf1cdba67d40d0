package io.furrow.bench.analytics;

import java.util.Arrays;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import jakarta.ws.rs.core.Context;
import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.bench.analytics.load.Fleet;

/** Progress of a job of this JVM, measured at its last operator. */
final class Progress {
    private static final ConcurrentHashMap<String, Progress> RUNS = new ConcurrentHashMap<>();

    private final long[] watermarks;
    private final LongAdder records = new LongAdder();
    private final ConcurrentHashMap<Long, LongAdder> starts = new ConcurrentHashMap<>();

    private Progress(int subtasks) {
        watermarks = new long[subtasks];
        Arrays.fill(watermarks, Fleet.START);
    }

    static Progress start(String run, int subtasks) {
        Progress progress = new Progress(subtasks);
        RUNS.put(run, progress);
        return progress;
    }

    static Progress of(String run) {
        return RUNS.get(run);
    }

    synchronized void reached(int subtask, long watermark) {
        watermarks[subtask] = Math.max(watermarks[subtask], watermark);
    }

    /** Event time, in milliseconds, that all subtasks have passed. */
    synchronized long millis() {
        return Arrays.stream(watermarks).min().orElse(Fleet.START) - Fleet.START;
    }

    void written(Encounter encounter) {
        records.increment();
        if (encounter.phase() == Phase.STARTED) {
            starts.computeIfAbsent((encounter.time() - Fleet.START) / 1000, second -> new LongAdder())
                    .increment();
        }
    }

    long records() {
        return records.sum();
    }

    /** Encounters that started in a second of event time. */
    long starts(long second) {
        LongAdder adder = starts.get(second);
        return adder == null ? 0 : adder.sum();
    }

    /** The sink of a measured job: counts, and reports event time to {@link Progress}. */
    record Counter(String run) implements Sink<Encounter> {
        private static final long serialVersionUID = 1L;

        @Override
        public SinkWriter<Encounter> createWriter(WriterInitContext context) {
            Progress progress = Progress.of(run);
            int subtask = context.getTaskInfo().getIndexOfThisSubtask();
            return new SinkWriter<>() {
                @Override
                public void write(Encounter encounter, Context ignored) {
                    progress.written(encounter);
                }

                @Override
                public void writeWatermark(Watermark watermark) {
                    progress.reached(subtask, watermark.getTimestamp());
                }

                @Override
                public void flush(boolean endOfInput) {}

                @Override
                public void close() {}
            };
        }
    }
}
