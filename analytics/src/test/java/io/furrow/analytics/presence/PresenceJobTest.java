package io.furrow.analytics.presence;

import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine.ParameterException;

import io.furrow.analytics.TestEnvironment;
import io.furrow.analytics.field.FieldInput;
import io.furrow.analytics.presence.Plot.Box;
import io.furrow.flink.JobCommandLine;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;

class PresenceJobTest {
    private static final Logger LOG = LoggerFactory.getLogger(PresenceJobTest.class);

    static final InMemoryReporter METRICS = InMemoryReporter.create();

    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setConfiguration(METRICS.addToConfiguration(new Configuration()))
            .setNumberTaskManagers(1)
            .setNumberSlotsPerTaskManager(4)
            .build());

    private static final int MORE_THAN_ANY_TEST_WRITES = 10_000;
    /** Time of a record whose watermark is the first that there is. */
    static final long FIRST = Long.MIN_VALUE + Story.BOUND + 2;

    private static final Plot FIELD = new Plot("f", 0, List.of(new Box(1, 1, 1 + 5e-4, 1 + 5e-4)), null);

    /** In any order of arrival, at any parallelism: what the definition says of several stories after each other. */
    @ParameterizedTest
    @ValueSource(ints = {1, 2, 4})
    void tellsTheSameAsTheDefinition(int parallelism) throws Exception {
        long seed = Long.getLong("presence.seed", System.nanoTime());
        LOG.info("stories of presence as a job from seed {}", seed);
        for (int index = 0; index < 5; index++) {
            Story story = new Story(seed + index);
            PresenceOptions options = options(
                    "--dwell", story.rules.dwell().toMillis() + "ms",
                    "--time-to-live", story.rules.timeToLive().toMillis() + "ms",
                    "--parallelism", Integer.toString(parallelism));

            List<TopicRecord> written = run(
                    options,
                    story.plots,
                    story.arrivals().stream().map(PresenceJobTest::report).toArray(TopicRecord[]::new));

            assertThat(written.stream().map(PresenceJobTest::line).sorted())
                    .as("story %d of seed %d", index, seed)
                    .containsExactlyElementsOf(PresenceOracle.passages(story.fixes, story.plots, story.rules));
        }
    }

    @Test
    void writesEntitiesOfDeviceAndField() throws Exception {
        List<TopicRecord> written = run(
                options(), List.of(FIELD), report(Story.fix("r1", 2, 3, 1000)), report(Story.fix("r1", 9, 3, 4000)));

        assertThat(written).extracting(TopicRecord::topic).containsOnly("data.presence");
        Entity entered = entity(written.get(0));
        Entity left = entity(written.get(1));
        assertThat(entered.id()).isEqualTo(left.id()).startsWith("Analytics:Presence:");
        assertThat(left.type()).isEqualTo("Analytics:Presence");
        assertThat(entered.text("phase")).contains("entered");
        assertThat(entered.value("dwell")).isEmpty();
        assertThat(left.text("phase")).contains("left");
        assertThat(left.text("cause")).contains("moved");
        assertThat(left.text("device")).contains("r1");
        assertThat(left.text("field")).contains("f");
        assertThat(left.text("Mission")).contains("hoeing");
        assertThat(left.number("dwell")).contains(3000.0);
        assertThat(left.number("startTime")).contains(1000.0);
        assertThat(left.number("time")).contains(4000.0);
        assertThat(left.text("stay")).isEqualTo(entered.text("stay"));
        assertThat(new String(written.get(1).key(), StandardCharsets.UTF_8)).isEqualTo("r1");
        assertThat(written.get(1).timestamp()).isEqualTo(4000);
        assertThat(written.get(1).headers())
                .containsEntry(HeaderNames.SERVICE, "farm")
                .containsEntry(HeaderNames.SERVICE_PATH, "/");
    }

    @Test
    void keepsAReplayToItselfAndItsResultsWithIt() throws Exception {
        String replay = "data.hoeing.replay.0a1b2c3d";
        List<TopicRecord> written = run(
                options("--parallelism", "1"),
                List.of(FIELD),
                report(Story.fix("r1", 2, 3, 1000)),
                report(Story.fix("r1", 9, 3, 1500)).to(replay),
                report(Story.fix("r1", 3, 3, 2000)).to(replay),
                report(Story.fix("r1", 9, 3, 4000)),
                report(Story.fix("r1", 9, 3, 1000)).to(replay));

        assertThat(written)
                .extracting(TopicRecord::topic, TopicRecord::timestamp)
                .containsExactlyInAnyOrder(
                        tuple("data.presence", 1000L),
                        tuple(replay + ".presence.late", 1000L),
                        tuple(replay + ".presence", 2000L),
                        tuple("data.presence", 4000L),
                        tuple(replay + ".presence", 302_000L));
    }

    @Test
    void setsAsideWhatIsUnreadableOrLate() throws Exception {
        TopicRecord garbage = record("x", 1000, "{not json");
        List<TopicRecord> written = run(
                options("--parallelism", "1"),
                List.of(FIELD),
                report(Story.fix("r1", 2, 3, 1000)),
                garbage,
                record("r2", 1000, null),
                report(Story.fix("r1", 2, 3, 90_000)),
                report(Story.fix("r1", 9, 9, 2000)));

        assertThat(written)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.presence", "data.presence", "data.presence.late", "data.raw.dead");
        assertThat(written)
                .filteredOn(record -> record.topic().endsWith(".dead"))
                .allSatisfy(dead -> assertThat(dead.headers()).containsEntry(DeadLetter.STAGE, "presence"));
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.presence.late"))
                .singleElement()
                .satisfies(late -> assertThat(late.timestamp()).isEqualTo(2000));
    }

    @Test
    void refusesRulesThatCannotBeKept() {
        assertThatThrownBy(() -> options("--time-to-live", "0s").rules())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--time-to-live must be longer than 0");
    }

    private static List<TopicRecord> run(PresenceOptions options, List<Plot> plots, TopicRecord... records)
            throws Exception {
        StreamExecutionEnvironment env = TestEnvironment.of(options);
        env.setBufferTimeout(0); // what was sent first is there first
        env.setParallelism(options.parallelism().orElse(2));
        List<TopicRecord> all = new ArrayList<>(List.of(record("the first", FIRST, null)));
        all.addAll(Arrays.asList(records));
        DataStream<TopicRecord> source = env.fromData(all)
                .setParallelism(1)
                .uid("records")
                .assignTimestampsAndWatermarks(WatermarkStrategy.<TopicRecord>forGenerator(context -> new EachRecord())
                        .withTimestampAssigner((record, ignored) -> record.timestamp()))
                .setParallelism(1)
                .uid("timestamps")
                .filter(new AfterFields(options.parallelism().orElse(2)))
                .setParallelism(1)
                .uid("after-fields");
        ArrayList<Plot> known = new ArrayList<>(plots);
        DataStream<TopicRecord> versions = env.fromData(records(known))
                .setParallelism(1)
                .uid("fields")
                .assignTimestampsAndWatermarks(WatermarkStrategy.forGenerator(context -> new NoHindrance()))
                .setParallelism(1)
                .uid("no-hindrance");
        PresenceJob.Inputs in = new PresenceJob.Inputs(source, new FieldInput(versions, () -> records(known)));
        List<TopicRecord> written = PresenceJob.define(in, options).executeAndCollect(MORE_THAN_ANY_TEST_WRITES);
        written.sort(Comparator.comparingLong(TopicRecord::timestamp));
        return written;
    }

    private static List<TopicRecord> records(List<Plot> plots) {
        List<TopicRecord> records = new ArrayList<>();
        plots.forEach(plot -> records.add(plot.record(records.size())));
        return records;
    }

    /** A watermark after every record, so that a short job has as many as a long one. */
    private static final class EachRecord implements WatermarkGenerator<TopicRecord> {
        private long newest = Long.MIN_VALUE + Story.BOUND + 1;

        @Override
        public void onEvent(TopicRecord event, long time, WatermarkOutput output) {
            newest = Math.max(newest, time);
            output.emitWatermark(new Watermark(newest - Story.BOUND - 1));
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }

    private static final class NoHindrance implements WatermarkGenerator<TopicRecord> {
        @Override
        public void onEvent(TopicRecord event, long time, WatermarkOutput output) {
            output.emitWatermark(new Watermark(Long.MAX_VALUE - 1));
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }

    private static PresenceOptions options(String... args) {
        PresenceOptions options = new PresenceOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }

    private static TopicRecord report(PresenceFix fix) {
        Entity entity = Entity.builder(fix.id(), "ROBOT")
                .text("Mission", "hoeing")
                .number("Latitude", fix.latitude())
                .number("Longitude", fix.longitude())
                .build();
        return record(fix.id(), fix.time(), new String(entity.toBytes(), StandardCharsets.UTF_8));
    }

    private static TopicRecord record(String key, long time, String value) {
        byte[] bytes = value == null ? null : value.getBytes(StandardCharsets.UTF_8);
        Map<String, String> headers = Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/");
        return new TopicRecord("data.raw", 0, 7, time, key.getBytes(StandardCharsets.UTF_8), bytes, headers);
    }

    /** As {@link PresenceOracle#line}. */
    private static String line(TopicRecord record) {
        Entity entity = entity(record);
        return "data.raw|farm|/|%s %s %s at %d told %d from %s,%s %s since %d"
                .formatted(
                        entity.text("device").orElseThrow(),
                        entity.text("field").orElseThrow(),
                        entity.text("phase").orElseThrow(),
                        entity.number("time").orElseThrow().longValue(),
                        record.timestamp(),
                        entity.number("Longitude").orElseThrow(),
                        entity.number("Latitude").orElseThrow(),
                        entity.text("cause").orElseThrow(),
                        entity.number("startTime").orElseThrow().longValue());
    }

    private static Entity entity(TopicRecord record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) {
            throw new AssertionError("what the job wrote is an entity", e);
        }
    }
}
