package io.furrow.analytics.field;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.connector.source.util.ratelimit.RateLimiterStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.StateRecoveryOptions;
import org.apache.flink.connector.datagen.source.DataGeneratorSource;
import org.apache.flink.core.execution.JobClient;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.co.CoProcessFunction;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.apache.flink.util.CloseableIterator;
import org.apache.flink.util.Collector;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.record.TopicRecord;

import static org.assertj.core.api.Assertions.assertThat;

/** Where event time ends while the events are quiet, the first event after that, and all that follow, would be late. */
@Tag("full")
class FieldInputTest {
    private static final int EVENTS = 15;

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    @TempDir
    Path directory;

    private Path fields;

    @BeforeEach
    void writeFields() throws IOException {
        fields = Files.writeString(directory.resolve("fields.geojson"), """
                {"type": "FeatureCollection", "features": [{"type": "Feature", "id": "yard", "properties": {}, "geometry":
                {"type": "Polygon", "coordinates": [[[10, 50], [10.1, 50], [10.1, 50.1], [10, 50.1], [10, 50]]]}}]}
                """);
    }

    @Test
    void leavesEventTimeWhereItIsBesideAFile() throws Exception {
        Run run = new Run(new Configuration());

        assertThat(run.eventTimes()).containsOnly(Long.MIN_VALUE);

        run.job.cancel().get(1, TimeUnit.MINUTES);
    }

    @Test
    void leavesEventTimeWhereItIsBesideAFileAfterARestart() throws Exception {
        Run first = new Run(new Configuration());
        first.eventTimes();
        String savepoint = first.job
                .stopWithSavepoint(false, directory.toUri().toString(), SavepointFormatType.CANONICAL)
                .get(1, TimeUnit.MINUTES);

        Run restored = new Run(new Configuration()
                .set(StateRecoveryOptions.SAVEPOINT_PATH, savepoint)
                .set(StateRecoveryOptions.SAVEPOINT_IGNORE_UNCLAIMED_STATE, true)); // of what collects the times
        assertThat(restored.eventTimes()).containsOnly(Long.MIN_VALUE);

        restored.job.cancel().get(1, TimeUnit.MINUTES);
    }

    /** The fields of the file beside events of which no partition has had a record for the idle timeout. */
    private final class Run {
        private final JobClient job;
        private final CloseableIterator<Long> times;

        Run(Configuration configuration) throws Exception {
            PresenceOptions options = new PresenceOptions();
            JobCommandLine.of(options).parseArgs("--parallelism", "1", "--fields", fields.toString());
            StreamExecutionEnvironment env = JobEnvironment.create(options);
            env.configure(configuration);
            DataStream<TopicRecord> events = env.fromSource(
                            new DataGeneratorSource<>(
                                    FieldInputTest::event,
                                    Long.MAX_VALUE,
                                    RateLimiterStrategy.perSecond(EVENTS),
                                    TypeInformation.of(TopicRecord.class)),
                            WatermarkStrategy.forGenerator(context -> new Quiet()),
                            "Quiet events")
                    .uid("quiet-events");
            DataStream<Long> seen = events.connect(
                            FieldInput.of(env, options, options.fields()).recordsBeside(events))
                    .process(new TellEventTime())
                    .uid("tell-event-time");
            times = seen.collectAsync();
            job = env.executeAsync();
        }

        List<Long> eventTimes() {
            List<Long> first = new ArrayList<>();
            while (first.size() < EVENTS) {
                first.add(times.next());
            }
            return first;
        }
    }

    private static TopicRecord event(long number) {
        return new TopicRecord("data.raw", 0, number, number, new byte[0], new byte[0], Map.of());
    }

    private static final class Quiet implements WatermarkGenerator<TopicRecord> {
        @Override
        public void onEvent(TopicRecord event, long timestamp, WatermarkOutput output) {
            output.markIdle();
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {
            output.markIdle();
        }
    }

    private static final class TellEventTime extends CoProcessFunction<TopicRecord, TopicRecord, Long> {
        private static final long serialVersionUID = 1L;

        @Override
        public void processElement1(TopicRecord event, Context context, Collector<Long> out) {
            out.collect(context.timerService().currentWatermark());
        }

        @Override
        public void processElement2(TopicRecord field, Context context, Collector<Long> out) {
            throw new AssertionError("fields of a file are known before the first event");
        }
    }
}
