package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import picocli.CommandLine.ParameterException;

import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.ngsi.Entity;

import static io.furrow.analytics.collision.ReportedRun.START;
import static io.furrow.analytics.collision.ReportedRun.entity;
import static io.furrow.analytics.collision.ReportedRun.options;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** What the job reports courses and of the ways between reports, as it is written. */
class MotionJobTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2);

    @Test
    void tellsAPredictionOnceASecondUntilTheEncounterStarts() throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second <= 20; second++) {
            // Two meters per second towards the other, which stands 30.3 m away; reports four times a second.
            for (int quarter = 0; quarter < 4; quarter++) {
                records.add(robot("r1", "Robot", 2 * second + 0.5 * quarter, 1000 * second + 250 * quarter));
                records.add(robot("r2", "Robot", 30.3, 1000 * second + 250 * quarter));
            }
        }
        List<TopicRecord> written = run(options("--horizon", "5s"), records);

        List<Entity> predicted = phases(written, "predicted");
        Entity first = predicted.get(0);
        assertThat(first.id()).startsWith("Analytics:Collision:").endsWith(":predicted");
        assertThat(first.type()).isEqualTo("Analytics:Collision");
        assertThat(first.text("Device1_ID")).contains("r1");
        // Five seconds before the first is 5 m from the second, at most a report's time late.
        assertThat(time(first)).isEqualTo(START + 7750);
        assertThat(first.number("tcpa"))
                .hasValueSatisfying(tcpa -> assertThat(tcpa).isBetween(4.7, 5.01));
        assertThat(first.number("dcpa"))
                .hasValueSatisfying(dcpa -> assertThat(dcpa).isBetween(4.7, 4.9));
        assertThat(first.number("distance"))
                .hasValueSatisfying(d -> assertThat(d).isBetween(14.7, 14.9));
        assertThat(predicted)
                .extracting(each -> each.text("encounter").orElseThrow())
                .containsOnly(first.text("encounter").orElseThrow());
        // From 7.75 s to 12.75 s, when the encounter starts.
        assertThat(predicted).hasSize(5);
        assertThat(phases(written, "started"))
                .singleElement()
                .satisfies(started -> assertThat(time(started)).isEqualTo(START + 12_750));
    }

    @Test
    void neverAltersTheEncounters() throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second <= 12; second++) {
            records.add(robot("r1", "Robot", 20 * second - 127, 1000 * second));
            records.add(robot("r2", "Robot", 3 * second, 1000 * second));
            records.add(robot("r3", "Robot", 24, 1000 * second));
        }
        List<TopicRecord> alone = run(options(), records);
        List<TopicRecord> beside = run(options("--horizon", "5s", "--crossed"), records);

        assertThat(alone).isNotEmpty();
        assertThat(phases(beside, "predicted")).isNotEmpty();
        assertThat(phases(beside, "crossed")).isNotEmpty();
        assertThat(beside.stream().filter(record -> !isOfMotion(record)).map(MotionJobTest::text))
                .isEqualTo(alone.stream().map(MotionJobTest::text).toList());
    }

    @Test
    void tellsWhereTwoDevicesCrossedBetweenTheirReports() throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second <= 10; second++) {
            records.add(robot("r1", "Robot", 20 * second - 90, 1000 * second));
            records.add(robot("r2", "Robot", 0, 1000 * second));
        }
        List<TopicRecord> written = run(options("--crossed"), records);

        assertThat(written).singleElement().satisfies(record -> {
            Entity crossed = entity(record);
            assertThat(crossed.text("phase")).contains("crossed");
            assertThat(record.timestamp()).isBetween(START + 4499, START + 4501);
            assertThat(crossed.number("dcpa"))
                    .hasValueSatisfying(dcpa -> assertThat(dcpa).isLessThan(0.05));
            assertThat(crossed.number("Device1_latitude")).contains(0.0);
            assertThat(crossed.number("Device1_timestamp")).contains((double) record.timestamp());
        });
    }

    @Tag("full")
    @Test
    void looksOnlyAtTheTypesThatMove() throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second <= 10; second++) {
            records.add(robot("r1", "Robot", 20 * second - 90, 1000 * second));
            records.add(robot("t1", "Thermometer", 0, 1000 * second));
            records.add(robot("t2", "Tractor", 1, 1000 * second));
        }
        assertThat(run(options("--crossed", "--moving-types", "Robot,Tractor"), records))
                .filteredOn(record -> isOfMotion(record))
                .singleElement()
                .satisfies(
                        record -> assertThat(entity(record).text("Device2_ID")).contains("t2"));
    }

    @Tag("full")
    @Test
    void leavesOutWhatIsFasterThanAnyMachine() throws Exception {
        List<TopicRecord> records = new ArrayList<>();
        for (int second = 0; second <= 10; second++) {
            records.add(robot("r1", "Robot", 20 * second - 90, 1000 * second));
            records.add(robot("r2", "Robot", 0, 1000 * second));
        }
        assertThat(run(options("--crossed", "--horizon", "10s", "--max-speed", "19"), records))
                .isEmpty();
        assertThat(run(options("--crossed", "--horizon", "10s", "--max-speed", "21"), records))
                .isNotEmpty();
    }

    @Test
    void refusesAHorizonThatReachesTooFar() {
        assertThatThrownBy(() -> options("--horizon", "10min").motionRules())
                .isInstanceOf(ParameterException.class)
                .hasMessage("the horizon of 600.0 s at the greatest speed of 30.0 m/s leads more than 10000.0 m ahead; "
                        + "make one of them less");
        assertThatThrownBy(() -> options("--max-speed", "0").motionRules())
                .isInstanceOf(ParameterException.class)
                .hasMessage("the greatest speed must be above 0 m/s, not 0.0");
        assertThat(options().motionRules().any()).isFalse();
    }

    private static List<Entity> phases(List<TopicRecord> written, String phase) {
        return written.stream()
                .map(ReportedRun::entity)
                .filter(entity -> entity.text("phase").filter(phase::equals).isPresent())
                .toList();
    }

    private static boolean isOfMotion(TopicRecord record) {
        return entity(record).id().matches(".*:(predicted|crossed)");
    }

    private static long time(Entity entity) {
        return entity.number("time").orElseThrow().longValue();
    }

    private static String text(TopicRecord record) {
        return record.timestamp() + " " + new String(record.value(), UTF_8);
    }

    private static List<TopicRecord> run(CollisionOptions options, List<TopicRecord> records) throws Exception {
        List<TopicRecord> written = ReportedRun.run(options, records.toArray(TopicRecord[]::new));
        written.sort(Comparator.comparingLong(TopicRecord::timestamp).thenComparing(MotionJobTest::text));
        return written;
    }

    private static TopicRecord robot(String id, String type, double east, long time) {
        return ReportedRun.record(id, time, ReportedRun.text(ReportedRun.placed(Entity.builder(id, type), east)));
    }
}
