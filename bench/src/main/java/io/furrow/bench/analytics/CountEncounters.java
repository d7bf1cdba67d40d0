package io.furrow.bench.analytics;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;

import io.furrow.analytics.collision.encounter.Encounter;

/** The end of a measured job: counts, and notifies {@link Progress} how far event time has come. */
record CountEncounters(String run) implements Sink<Encounter> {
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
