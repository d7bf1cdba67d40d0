package io.furrow.analytics.presence;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;
import java.util.stream.LongStream;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine.ParameterException;

import io.furrow.analytics.Replayed;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.presence.Plot.Box;
import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static io.furrow.analytics.presence.PresenceRun.entity;
import static io.furrow.analytics.presence.PresenceRun.options;
import static io.furrow.analytics.presence.PresenceRun.record;
import static io.furrow.analytics.presence.PresenceRun.report;
import static io.furrow.analytics.presence.PresenceRun.run;
import static io.furrow.analytics.presence.Story.fix;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.tuple;

class PresenceJobTest {
    private static final Logger LOG = LoggerFactory.getLogger(PresenceJobTest.class);

    static final InMemoryReporter METRICS = InMemoryReporter.create();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(4, METRICS.addToConfiguration(new Configuration()));

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
                    story.arrivals().stream().map(PresenceRun::report).toArray(TopicRecord[]::new));

            assertThat(written.stream().map(PresenceRun::line).sorted())
                    .as("story %d of seed %d", index, seed)
                    .containsExactlyElementsOf(PresenceOracle.passages(story.fixes, story.plots, story.rules));
        }
    }

    @Test
    void writesEntitiesOfDeviceAndField() throws Exception {
        List<TopicRecord> written =
                run(options(), List.of(FIELD), report(fix("r1", 2, 3, 1000)), report(fix("r1", 9, 3, 4000)));

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
        assertThat(left.text("deviceType")).contains("ROBOT");
        assertThat(left.text("field")).contains("f");
        assertThat(left.text("Mission")).contains("hoeing");
        assertThat(left.number("dwell")).contains(3000.0);
        assertThat(left.number("startTime")).contains(1000.0);
        assertThat(left.number("time")).contains(4000.0);
        assertThat(left.text("stay")).isEqualTo(entered.text("stay"));
        assertThat(new String(written.get(1).key(), UTF_8)).isEqualTo("r1");
        assertThat(written.get(1).timestamp()).isEqualTo(4000);
        assertThat(written.get(1).headers())
                .containsAllEntriesOf(Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/"));
    }

    @Test
    void keepsAReplayToItselfAndItsResultsWithIt() throws Exception {
        String replay = "data.hoeing.replay.0a1b2c3d";
        List<TopicRecord> written = run(
                options("--parallelism", "1"),
                List.of(FIELD),
                report(fix("r1", 2, 3, 1000)),
                report(fix("r1", 9, 3, 1500)).to(replay),
                report(fix("r1", 3, 3, 2000)).to(replay),
                report(fix("r1", 9, 3, 4000)),
                report(fix("r1", 9, 3, 1000)).to(replay));

        assertThat(written)
                .extracting(TopicRecord::topic, TopicRecord::timestamp)
                .containsExactlyInAnyOrder(
                        tuple("data.presence", 1000L),
                        tuple(replay + ".presence.late", 1000L),
                        tuple(replay + ".presence", 2000L),
                        tuple("data.presence", 4000L),
                        tuple(replay + ".presence", 302_000L));
    }

    @Tag("full")
    @Test
    void setsAsideWhatIsUnreadableOrLate() throws Exception {
        TopicRecord garbage = record("x", 1000, "{not json");
        List<TopicRecord> written = run(
                options("--parallelism", "1"),
                List.of(FIELD),
                report(fix("r1", 2, 3, 1000)),
                garbage.to("reports"),
                garbage, // of data.raw, which ingest sets aside
                record("r2", 1000, null),
                report(fix("r1", 2, 3, 90_000)),
                report(fix("r1", 9, 9, 2000)));

        assertThat(written)
                .extracting(TopicRecord::topic)
                .containsExactlyInAnyOrder("data.presence", "data.presence", "data.presence.late", "reports.dead");
        assertThat(written)
                .filteredOn(record -> record.topic().endsWith(".dead"))
                .allSatisfy(dead -> assertThat(dead.headers()).containsEntry(DeadLetter.STAGE, "presence"));
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.presence.late"))
                .singleElement()
                .satisfies(late -> assertThat(late.timestamp()).isEqualTo(2000));
    }

    @Test
    void seesADeviceWhoseClockIsBehindOnceThatIsCorrected() throws Exception {
        long behind = Story.BOUND + 3000;
        List<TopicRecord> reports = new ArrayList<>();
        for (long now = 1_000_000; now < 1_200_000; now += 1000) {
            String received = Long.toString(now);
            reports.add(report(fix("right", 9, 9, now)).with(HeaderNames.TS_SOURCE, received));
            reports.add(report(fix("slow", 2, 3, now - behind)).with(HeaderNames.TS_SOURCE, received));
        }
        TopicRecord[] all = reports.toArray(TopicRecord[]::new);

        List<TopicRecord> written = run(options("--parallelism", "1"), List.of(FIELD), all);
        assertThat(written)
                .extracting(TopicRecord::topic)
                .contains("data.clocks")
                .doesNotContain("data.presence");

        written = run(options("--parallelism", "1", "--clock-correction", "on"), List.of(FIELD), all);
        assertThat(written)
                .filteredOn(record -> record.topic().equals("data.presence"))
                .extracting(record -> entity(record).text("device").orElseThrow())
                .containsOnly("slow");
        assertThat(written)
                .filteredOn(record -> entity(record).type().equals("Analytics:ClockOffset"))
                .singleElement()
                .satisfies(offset -> {
                    assertThat(entity(offset).text("job")).contains("presence");
                    assertThat(entity(offset).number("offset")).contains((double) behind);
                });
    }

    @Tag("full")
    @Test
    void tellsOfEachEpochOfAReplayWhatItTellsOfItAlone() throws Exception {
        long seed = Long.getLong("presence.seed", System.nanoTime());
        LOG.info("replay of a story of presence from seed {}", seed);
        Story story = storyWithPassagesInBothHalves(seed);
        PresenceOptions options = options(("--input %s --out-of-orderness %dms --dwell %dms --time-to-live %dms")
                .formatted(
                        Replayed.TOPIC,
                        Story.BOUND,
                        story.rules.dwell().toMillis(),
                        story.rules.timeToLive().toMillis())
                .split(" "));
        var arrivals = story.arrivals().stream().map(PresenceRun::report).toList();

        Replayed.assertThatEpochsAreAsAlone(
                Replayed.epochs(arrivals, middle(story)),
                records -> run(options, story.plots, records.toArray(TopicRecord[]::new)));
    }

    /** In two of a hundred random stories nobody enters a field in one of the halves, and nothing would be compared. */
    private static Story storyWithPassagesInBothHalves(long seed) {
        return LongStream.iterate(seed, next -> next + 1)
                .mapToObj(Story::new)
                .filter(story -> hasPassages(story, fix -> fix.time() <= middle(story))
                        && hasPassages(story, fix -> fix.time() > middle(story)))
                .findFirst()
                .orElseThrow();
    }

    private static boolean hasPassages(Story story, Predicate<PositionFix> half) {
        List<PositionFix> fixes = story.fixes.stream().filter(half).toList();
        return !PresenceOracle.passages(fixes, story.plots, story.rules).isEmpty();
    }

    private static long middle(Story story) {
        return story.fixes.get(0).time() + 200;
    }

    @Test
    void refusesRulesThatCannotBeKept() {
        assertThatThrownBy(() -> options("--time-to-live", "0s").rules())
                .isInstanceOf(ParameterException.class)
                .hasMessageContaining("--time-to-live must be longer than 0");
    }
}
