package io.furrow.analytics.coverage;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.state.heap.HeapKeyedStateBackend;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedBroadcastOperatorTestHarness;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.FieldRecords;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;

import static org.assertj.core.api.Assertions.assertThat;

class CoverageStateTest {
    private static final long TIME_TO_LIVE = 3_600_000;
    private static final int ROBOTS = 200;
    private static final CoverageRules RULES = new CoverageRules(
            Double.NaN, 0.1, 10, Duration.ofSeconds(10), 0.5, Duration.ofSeconds(10), Duration.ofMillis(TIME_TO_LIVE));

    private final FieldRecords fields = new FieldRecords();

    @Test
    void reportsTheSameHoweverOftenItRestartsAndForgetsAfterTheTimeToLive() throws Exception {
        List<Swath> swaths = CoveredCellsTest.swaths(new Drives(5));
        long end = swaths.get(swaths.size() - 1).time();
        Covering whole = new Covering(RULES);
        Covering parts = new Covering(RULES);
        List<String> reports = new ArrayList<>();
        for (int i = 0; i < swaths.size(); i++) {
            whole.receive(swaths.get(i));
            parts.receive(swaths.get(i));
            if (i % 40 == 39) {
                parts.advance(swaths.get(i).time()).forEach(report -> reports.add(line(report)));
                parts.restart();
            }
        }
        parts.advance(end + TIME_TO_LIVE / 2).forEach(report -> reports.add(line(report)));

        assertThat(whole.advance(end + TIME_TO_LIVE / 2).stream()
                        .map(CoverageStateTest::line)
                        .sorted())
                .hasSizeGreaterThan(20)
                .containsExactlyElementsOf(reports.stream().sorted().toList());
        assertThat(parts.entries()).isPositive();
        assertThat(parts.advance(end + TIME_TO_LIVE)).isEmpty();
        assertThat(parts.entries()).isZero();
        assertThat(parts.timers()).isZero();
        whole.stop();
        parts.stop();
    }

    private static String line(CoverageReport report) {
        return "%s %d %d %d %d %s"
                .formatted(
                        report.last().key(),
                        report.time(),
                        report.covered(),
                        report.overlapped(),
                        report.gaps(),
                        report.perHour());
    }

    @Test
    void beginsAtZeroAfterTheTimeToLive() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        List<Swath> first = swaths("weeding", 0);
        List<Swath> later = swaths("weeding", 2 * TIME_TO_LIVE);
        Covering covering = new Covering(RULES);
        for (Swath swath : first) {
            covering.receive(swath);
        }
        for (Swath swath : later) {
            covering.receive(swath);
        }

        assertThat(covering.advance(Drives.START + 3 * TIME_TO_LIVE))
                .filteredOn(report -> !report.last().ofRobot())
                .hasSize(2)
                .allSatisfy(report -> assertThat(report.overlapped()).isZero())
                .extracting(CoverageReport::covered)
                .doesNotContain(0L);
        covering.stop();
    }

    @Test
    void forgetsRobotsThatAreSilentAndDevicesWithoutAnImplement() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        var operator = building();
        var harness = opened(operator);
        for (int second = 0; second < 5; second++) {
            long time = Drives.START + second * 1000;
            harness.processElement(new StreamRecord<>(report("weeding", second, time), time));
            WorkReport other = new WorkReport(Drives.fix("thermometer", "", 10, 10, time), Double.NaN, Work.UNKNOWN);
            harness.processElement(new StreamRecord<>(other, time));
        }
        harness.processWatermark(new Watermark(Drives.START + 4000));

        HeapKeyedStateBackend<?> state = (HeapKeyedStateBackend<?>) operator.getKeyedStateBackend();
        assertThat(harness.extractOutputValues()).hasSize(8);
        assertThat(state.numKeyValueStateEntries())
                .as("drive and timer of the robot")
                .isEqualTo(2);

        harness.processWatermark(new Watermark(Drives.START + 4000 + TIME_TO_LIVE));
        assertThat(state.numKeyValueStateEntries()).isZero();
        assertThat(harness.numEventTimeTimers()).isZero();
        harness.close();
    }

    private BroadcastLatenessOperator<String, WorkReport, TopicRecord, Swath> building() {
        return new BroadcastLatenessOperator<>(
                new BuildSwaths(RULES, new StoredFields(fields.all())), List.of(FieldVersions.BROADCAST));
    }

    private static KeyedBroadcastOperatorTestHarness<String, WorkReport, TopicRecord, Swath> opened(
            BroadcastLatenessOperator<String, WorkReport, TopicRecord, Swath> operator) throws Exception {
        var harness = new KeyedBroadcastOperatorTestHarness<String, WorkReport, TopicRecord, Swath>(
                operator, WorkReport::key, Types.STRING, 16, 1, 0);
        harness.open();
        harness.processBroadcastWatermark(Watermark.MAX_WATERMARK);
        return harness;
    }

    @Test
    void setsAsideAndNamesARobotWhoseClockIsBehind() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        var operator = building();
        var harness = opened(operator);
        harness.processWatermark(new Watermark(Drives.START + 10_000));
        for (int second = 0; second < 5; second++) {
            WorkReport slow = report("slow", "weeding", 10 + second, 10, Drives.START + second * 1000);
            harness.processElement(new StreamRecord<>(slow, slow.time()));
        }
        harness.processWatermark(new Watermark(Drives.START + 20_000));

        assertThat(harness.extractOutputValues()).isEmpty();
        assertThat(harness.getSideOutput(BuildSwaths.LATE)).hasSize(5);
        assertThat(harness.getSideOutput(BuildSwaths.LAGGING))
                .hasSize(5)
                .extracting(lagging -> lagging.getValue().id())
                .containsOnly("slow");
        assertThat(((HeapKeyedStateBackend<?>) operator.getKeyedStateBackend()).numKeyValueStateEntries())
                .isZero();
        assertThat(harness.numEventTimeTimers()).isZero();
        harness.close();
    }

    @Test
    void coversNothingWhereAClockJumps() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        List<Swath> swaths = new ArrayList<>();
        Drive drive = Drive.NONE;
        for (int second : new int[] {0, 1, 2, 1800, 1801, 1802}) {
            drive = advance(drive, report("weeding", second % 10, Drives.START + second * 1000L), swaths, new int[1]);
        }

        assertThat(swaths)
                .filteredOn(Swath::ofRobot)
                .extracting(swath -> (swath.time() - Drives.START) / 1000)
                .containsExactly(1L, 2L, 1801L, 1802L);
    }

    /** Each with a mission that no other has. */
    @Test
    void takesNoMoreCoveragesOfARobotThanTheMaximum() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        int[] rejected = new int[1];
        List<Swath> swaths = new ArrayList<>();
        Drive drive = Drive.NONE;
        for (int i = 0; i <= 2 * SwathBuilder.MAX_OPENED; i++) {
            drive = advance(drive, report("m" + i, i / 5.0, Drives.START + i * 1000), swaths, rejected);
        }
        assertThat(swaths).hasSize(2 * SwathBuilder.MAX_OPENED);
        assertThat(rejected).containsExactly(SwathBuilder.MAX_OPENED);
        assertThat(drive.opened()).hasSize(SwathBuilder.MAX_OPENED);

        long later = Drives.START + 2 * TIME_TO_LIVE;
        drive = advance(drive, report("new", 5, later), swaths, rejected);
        drive = advance(drive, report("new", 6, later + 1000), swaths, rejected);
        assertThat(drive.opened()).hasSize(1);
    }

    /** Side by side, so that none covers what another has. */
    @Test
    void coversAndForgetsWhatACrowdOfRobotsWorks() throws Exception {
        fields.area("f", 0, "", Drives.square(500));
        List<Swath> swaths = new ArrayList<>();
        for (int robot = 0; robot < ROBOTS; robot++) {
            Drive drive = Drive.NONE;
            for (int second = 0; second < 5; second++) {
                WorkReport report =
                        report("r" + robot, "weeding", 10 + second, 10 + 2 * robot, Drives.START + second * 1000);
                drive = advance(drive, report, swaths, new int[1]);
            }
        }
        Covering covering = new Covering(RULES);
        for (Swath swath : swaths) {
            covering.receive(swath);
        }
        List<CoverageReport> reports = covering.advance(Drives.START + 10_000);

        assertThat(reports).hasSize(ROBOTS + 1);
        CoverageReport all = reports.stream()
                .filter(report -> !report.last().ofRobot())
                .findAny()
                .orElseThrow();
        assertThat(all.overlapped()).isZero();
        assertThat(all.covered())
                .isPositive()
                .isEqualTo(reports.stream()
                        .filter(report -> report.last().ofRobot())
                        .mapToLong(CoverageReport::covered)
                        .sum());
        assertThat(covering.timers()).as("one per coverage").isEqualTo(ROBOTS + 1);
        assertThat(covering.advance(Drives.START + 4000 + TIME_TO_LIVE)).isEmpty();
        assertThat(covering.entries()).isZero();
        assertThat(covering.timers()).isZero();
        covering.stop();
    }

    /** What was covered before a pause does not count for the rate after it. */
    @Test
    void measuresTheRateFromWhereWorkGoesOn() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        long later = Drives.START + 2 * Reporter.RATE_WINDOW;
        List<Swath> swaths = new ArrayList<>();
        Drive drive = Drive.NONE;
        for (int second = 0; second < 10; second++) {
            long time = second < 5 ? Drives.START + second * 1000 : later + second * 1000;
            drive = advance(drive, report("weeding", second, time), swaths, new int[1]);
        }
        Covering covering = new Covering(RULES);
        for (Swath swath : swaths) {
            covering.receive(swath);
        }
        List<CoverageReport> own = covering.advance(later + 10_000).stream()
                .filter(report -> report.last().ofRobot())
                .toList();

        assertThat(own).hasSize(2);
        long newly = own.get(1).covered() - own.get(0).covered();
        assertThat(newly).isPositive();
        assertThat(own.get(1).perHour()).isEqualTo(newly * 3600 / 5.0);
        covering.stop();
    }

    @Test
    void retainsNoMoreSamplesThanTheRateNeeds() throws Exception {
        fields.area("f", 0, "", Drives.square(40));
        CoverageState state = CoverageState.begun(swaths("weeding", 0).get(0), 0.5);
        for (int report = 1; report <= 1000; report++) {
            state = state.reported(Drives.START + report * 10_000, Reporter.RATE_WINDOW, List.of());
        }

        assertThat(state.samples()).hasSize(61);
        assertThat(state.samples().get(0).time()).isEqualTo(Drives.START + 1000 * 10_000 - Reporter.RATE_WINDOW);
    }

    private List<Swath> swaths(String mission, long after) throws Exception {
        List<Swath> swaths = new ArrayList<>();
        Drive drive = Drive.NONE;
        for (int second = 0; second < 5; second++) {
            WorkReport report = report(mission, second, Drives.START + after + second * 1000);
            drive = advance(drive, report, swaths, new int[1]);
        }
        return swaths;
    }

    private Drive advance(Drive drive, WorkReport report, List<Swath> swaths, int[] rejected) throws Exception {
        FieldVersions known = FieldVersions.read(fields.atStart());
        return new SwathBuilder(RULES).advance(drive, report, known, new SwathBuilder.Output() {
            @Override
            public void accept(Swath swath) {
                swaths.add(swath);
            }

            @Override
            public void reject() {
                rejected[0]++;
            }
        });
    }

    private static WorkReport report(String mission, double way, long time) {
        return report("r", mission, 10 + way, 10, time);
    }

    private static WorkReport report(String robot, String mission, double east, double north, long time) {
        return new WorkReport(Drives.fix(robot, mission, east, north, time), 2, Work.ON);
    }
}
