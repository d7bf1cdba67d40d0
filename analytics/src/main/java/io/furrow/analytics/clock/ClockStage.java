package io.furrow.analytics.clock;

import java.time.Duration;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;

import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;

/** The stages for the clocks of devices in a job that follows positions. */
public final class ClockStage {
    private final ClockEntity entities;
    private final ReceiptTime receiptTime;
    private final Duration maxBehind;

    /** @param job its name, for instance {@code collision} */
    public ClockStage(String job, AnalyticsOptions options) {
        this.entities = new ClockEntity(job, options.clockOutput());
        this.receiptTime = ReceiptTime.of(options);
        this.maxBehind = options.clocks().maxBehind();
    }

    /** Reports devices whose records are all received long after their time, as entities. */
    public DataStream<TopicRecord> delays(DataStream<TopicRecord> records) {
        return records.process(new ReportDelayedDevices(receiptTime, maxBehind))
                .uid("report-delayed-devices")
                .name("Report delayed devices")
                .map(entities::of)
                .uid("describe-delayed-devices")
                .name("Describe delayed devices as entities");
    }

    /** Reports devices with a smaller lag, as entities. */
    public DataStream<TopicRecord> watch(DataStream<LaggingPosition> lagging) {
        return lagging.keyBy(LaggingPosition::key)
                .process(new DetectClockLag(maxBehind))
                .uid("detect-clock-lag")
                .name("Watch the clocks of devices")
                .map(entities::of)
                .uid("describe-clocks")
                .name("Describe clocks as entities");
    }

    /** Returns the records at corrected times. */
    public SingleOutputStreamOperator<TopicRecord> correct(DataStream<TopicRecord> records) {
        return records.keyBy(CorrectClocks::deviceOf)
                .process(new CorrectClocks(receiptTime))
                .uid("correct-clocks")
                .name("Correct the clocks of devices");
    }

    /** Returns the changes of offsets that {@link #correct} found, as entities. */
    public DataStream<TopicRecord> offsets(SingleOutputStreamOperator<TopicRecord> corrected) {
        return corrected
                .getSideOutput(CorrectClocks.REPORTS)
                .map(entities::of)
                .uid("describe-clock-offsets")
                .name("Describe offsets of clocks as entities");
    }
}
