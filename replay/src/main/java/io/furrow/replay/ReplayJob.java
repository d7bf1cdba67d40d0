package io.furrow.replay;

import java.util.Set;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.EnsureTopics;
import io.furrow.flink.JobEnvironment;
import io.furrow.flink.KafkaEnds;
import io.furrow.flink.KafkaOutput;
import io.furrow.flink.TopicOptions;
import io.furrow.flink.TopicRecord;
import io.furrow.mission.Recordings;
import io.furrow.model.topic.Topics;
import io.furrow.replay.source.ReplaySource;

/** Plays stored missions back, any number at once, each on a topic of its own. */
public final class ReplayJob {
    private static final String STATUSES = "statuses";

    private ReplayJob() {}

    /** The whole job on Kafka and MongoDB, ready to be executed. */
    public static StreamExecutionEnvironment assemble(ReplayOptions options) {
        return assemble(options, options.recordings());
    }

    /** The same with recordings from elsewhere. */
    static StreamExecutionEnvironment assemble(ReplayOptions options, Recordings recordings) {
        StreamExecutionEnvironment env = JobEnvironment.createPrompt(options);

        DataStream<TopicRecord> records = env.fromSource(
                        new ReplaySource(options.wanted(), recordings, options.pages()),
                        WatermarkStrategy.noWatermarks(),
                        "Play replays")
                .uid("play-replays");
        define(records, toKafka(options), options);

        return env;
    }

    /** The pipeline; all in one chain, so that the records of a replay stay in order. */
    static void define(DataStream<TopicRecord> records, KafkaOutput kafka, ReplayOptions options) {
        DataStream<TopicRecord> played =
                records.filter(record -> !isStatus(record)).uid("select-played").name("Select what was played");
        kafka.write("played", played);

        if (!options.isOnce()) {
            DataStream<TopicRecord> statuses =
                    records.filter(ReplayJob::isStatus).uid("select-statuses").name("Select statuses");
            kafka.write(STATUSES, statuses);
        }
    }

    private static boolean isStatus(TopicRecord record) {
        return record.topic().equals(Topics.REPLAYS_STATUS);
    }

    /** What is played goes under the job's delivery guarantee; a status is visible at once. */
    private static KafkaOutput toKafka(ReplayOptions options) {
        TopicOptions.Settings topics =
                options.topics().settings(Set.of(Topics.REPLAYS_STATUS)).withReplayBytes(options.topicBytes());
        return (name, records) -> {
            DataStream<TopicRecord> writable = records.map(new EnsureTopics(options, topics))
                    .uid("ensure-topics-of-" + name)
                    .name("Ensure topics of " + name);
            if (name.equals(STATUSES)) {
                writable.sinkTo(KafkaEnds.promptSink(options, name))
                        .uid("write-statuses")
                        .name("Write statuses");
            } else {
                writable.flatMap(new ToEveryPartition(options))
                        .uid("to-every-partition")
                        .name("Ends to every partition")
                        .sinkTo(KafkaEnds.sink(options))
                        .uid("write-played")
                        .name("Write what was played");
            }
        };
    }
}
