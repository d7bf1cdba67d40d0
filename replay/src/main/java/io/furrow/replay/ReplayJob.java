package io.furrow.replay;

import java.util.Set;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.kafka.EnsureTopics;
import io.furrow.flink.kafka.KafkaConnectors;
import io.furrow.flink.kafka.KafkaOutput;
import io.furrow.flink.kafka.TopicOptions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.topic.Topics;
import io.furrow.replay.recording.RecordingSources;
import io.furrow.replay.source.ReplaySource;
import io.furrow.replay.topic.ReplayTopics;

/** Plays any number of stored missions at once, each on its own topic. */
public final class ReplayJob {
    private static final String STATUSES = "statuses";

    private ReplayJob() {}

    /** Returns the whole job on Kafka and MongoDB, ready to be executed. */
    public static StreamExecutionEnvironment assemble(ReplayOptions options) {
        return assemble(options, options.recordings());
    }

    /** Returns the same job with other recordings. */
    static StreamExecutionEnvironment assemble(ReplayOptions options, RecordingSources recordings) {
        StreamExecutionEnvironment env = JobEnvironment.createPrompt(options);

        DataStream<TopicRecord> records = env.fromSource(
                        new ReplaySource(
                                options.desired(),
                                recordings,
                                options.pages(),
                                ReplayTopics.of(options, topics(options))),
                        WatermarkStrategy.noWatermarks(),
                        "Play replays")
                .uid("play-replays");
        define(records, toKafka(options), options);

        return env;
    }

    /** Defines the pipeline as a single chain, so that the records of a replay stay in order. */
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

    /** Writes played records with the job's delivery guarantee, and statuses at once. */
    private static KafkaOutput toKafka(ReplayOptions options) {
        return (name, records) -> {
            if (name.equals(STATUSES)) {
                records.map(new EnsureTopics(options, topics(options)))
                        .uid("ensure-topics-of-" + name)
                        .name("Ensure topics of " + name)
                        .sinkTo(KafkaConnectors.promptSink(options, name))
                        .uid("write-statuses")
                        .name("Write statuses");
            } else {
                records.sinkTo(KafkaConnectors.sink(options))
                        .uid("write-played")
                        .name("Write what was played");
            }
        };
    }

    private static TopicOptions.Settings topics(ReplayOptions options) {
        return options.topics().settings(Set.of(Topics.REPLAYS_STATUS)).withReplayBytes(options.topicBytes());
    }
}
