package io.furrow.flink.restart;

import java.util.List;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.connector.datagen.source.GeneratorFunction;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.record.TopicRecord;

/**
 * The source of the job that runs: its position is in checkpoints, its event time is not, as with Kafka. A watermark follows
 * every record, so that what is late depends on the input alone. Static because the tasks run in this process.
 */
final class Input {
    static final String NAME = "Input";
    static final Gate GATE = new Gate();

    private static volatile List<JobCase.Arrival> arrivals;
    private static volatile Judges judges;
    private static volatile long newest;

    private Input() {}

    static void newRun(JobCase job, int first, Judges seenBy) {
        arrivals = job.arrivals;
        judges = seenBy;
        newest = Long.MIN_VALUE;
        GATE.newRun(first);
    }

    static DataStream<TopicRecord> of(StreamExecutionEnvironment env, JobCase job) {
        GeneratorFunction<Long, TopicRecord> nth = index -> take(index.intValue());
        long bound = job.bound();
        return env.fromSource(
                        new DataGeneratorSource<>(
                                nth, job.arrivals.size(), new Gate.Limit<>(), TypeInformation.of(TopicRecord.class)),
                        WatermarkStrategy.<TopicRecord>forGenerator(context -> new AfterEachRecord(bound))
                                .withTimestampAssigner((record, unused) -> record.timestamp()),
                        NAME)
                .setParallelism(1)
                .uid("input")
                .rebalance(); // chained at one parallelism only, it would lose what is on its way when rescaled
    }

    private static TopicRecord take(int index) {
        JobCase.Arrival arrival = arrivals.get(index);
        if (arrival.afterAll()) {
            awaitJudges();
        }
        newest = Math.max(newest, arrival.record().timestamp());
        GATE.passed(index);
        return arrival.record();
    }

    /** Until the judges have the watermark of all records of this run so far. */
    static void awaitJudges() {
        if (newest != Long.MIN_VALUE) {
            judges.await(newest);
        }
    }

    private static final class AfterEachRecord implements WatermarkGenerator<TopicRecord> {
        private final long bound;
        private long newest = Long.MIN_VALUE;

        AfterEachRecord(long bound) {
            this.bound = bound;
        }

        @Override
        public void onEvent(TopicRecord record, long time, WatermarkOutput output) {
            newest = Math.max(newest, time);
            output.emitWatermark(new Watermark(newest - bound - 1));
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }
}
