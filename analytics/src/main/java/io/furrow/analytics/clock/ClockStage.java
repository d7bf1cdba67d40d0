package io.furrow.analytics.clock;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;

import io.furrow.flink.record.Receipt;
import io.furrow.flink.record.TopicRecord;

/** The clocks of devices in a job that follows positions. */
public final class ClockStage {
    private final ClockEntity entities;

    /** @param job its name, for instance {@code collision} */
    public ClockStage(String job, ClockSettings settings) {
        this.entities = new ClockEntity(job, settings.output());
    }

    /** Reports the devices that are behind, as entities. */
    public DataStream<TopicRecord> watch(DataStream<LaggingPosition> lagging) {
        return lagging.keyBy(LaggingPosition::key)
                .process(new WatchClocks())
                .uid("watch-clocks")
                .name("Watch the clocks of devices")
                .map(entities::of)
                .uid("describe-clocks")
                .name("Describe clocks as entities");
    }

    /** The records at corrected times. */
    public static SingleOutputStreamOperator<TopicRecord> correct(DataStream<TopicRecord> records, Receipt receipt) {
        return records.keyBy(CorrectClocks::deviceOf)
                .process(new CorrectClocks(receipt))
                .uid("correct-clocks")
                .name("Correct the clocks of devices");
    }

    /** The changes of offsets that {@link #correct} found, as entities. */
    public DataStream<TopicRecord> offsets(SingleOutputStreamOperator<TopicRecord> corrected) {
        return corrected
                .getSideOutput(CorrectClocks.REPORTS)
                .map(entities::of)
                .uid("describe-clock-offsets")
                .name("Describe offsets of clocks as entities");
    }
}
