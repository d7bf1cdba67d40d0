package io.furrow.replay.source;

import java.util.function.Consumer;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.connector.source.ReaderOutput;
import org.apache.flink.api.connector.source.SourceEvent;
import org.apache.flink.api.connector.source.SourceOutput;
import org.apache.flink.api.connector.source.SourceReaderContext;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.groups.SourceReaderMetricGroup;
import org.apache.flink.metrics.testutils.MetricListener;
import org.apache.flink.runtime.metrics.groups.InternalSourceReaderMetricGroup;
import org.apache.flink.util.UserCodeClassLoader;

import io.furrow.flink.record.TopicRecord;

/** The context of a reader, with its metrics. */
final class FakeContext implements SourceReaderContext {
    private final MetricListener metrics = new MetricListener();

    @Override
    public SourceReaderMetricGroup metricGroup() {
        return InternalSourceReaderMetricGroup.mock(metrics.getMetricGroup());
    }

    /** Returns the value of a replay's gauge. */
    Object gauge(String replay, String name) {
        return metrics.getGauge("replay", replay, name).orElseThrow().getValue();
    }

    @Override
    public Configuration getConfiguration() {
        return new Configuration();
    }

    @Override
    public String getLocalHostName() {
        return "here";
    }

    @Override
    public int getIndexOfSubtask() {
        return 0;
    }

    @Override
    public void sendSplitRequest() {
        throw new UnsupportedOperationException("readers request no splits");
    }

    @Override
    public void sendSourceEventToCoordinator(SourceEvent event) {
        throw new UnsupportedOperationException("readers send no events");
    }

    @Override
    public UserCodeClassLoader getUserCodeClassLoader() {
        throw new UnsupportedOperationException("readers load no classes");
    }

    /** @param to receives the records */
    record Output(Consumer<TopicRecord> to) implements ReaderOutput<TopicRecord> {
        @Override
        public void collect(TopicRecord record) {
            to.accept(record);
        }

        @Override
        public void collect(TopicRecord record, long timestamp) {
            to.accept(record);
        }

        @Override
        public void emitWatermark(Watermark watermark) {
            // not tested
        }

        @Override
        public void markIdle() {
            // not tested
        }

        @Override
        public void markActive() {
            // not tested
        }

        @Override
        public SourceOutput<TopicRecord> createOutputForSplit(String split) {
            return this;
        }

        @Override
        public void releaseOutputForSplit(String split) {
            // not tested
        }
    }
}
