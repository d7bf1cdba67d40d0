package io.furrow.flink.kafka;

import java.time.Duration;
import java.util.Optional;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamSource;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.AdvanceIdleInput;

/** The input of the analytics jobs. */
public final class KafkaInput {
    private KafkaInput() {}

    /**
     * The topics of {@code --input}, with event time, from the source of the uid {@code reported-changes}.
     *
     * @param maxDrift how far partitions of live topics may be ahead of the slowest; never applies to a replay, nor with
     *     the idle advance, where the slowest may be as far behind as its last record
     */
    public static DataStream<TopicRecord> reportedChanges(
            StreamExecutionEnvironment env, JobOptions options, Optional<Duration> maxDrift) {
        boolean replay = options.inputTopics().replay().isPresent();
        WatermarkStrategy<TopicRecord> watermarks =
                KafkaConnectors.watermarks(options, replay || options.idleAdvance() ? Optional.empty() : maxDrift);
        DataStreamSource<TopicRecord> records =
                env.fromSource(KafkaConnectors.source(options), watermarks, "Reported changes");
        if (replay) {
            records.setParallelism(1); // a pause of the replay is visible in all partitions only
        }
        return AdvanceIdleInput.of(records.uid("read-events"), options);
    }
}
