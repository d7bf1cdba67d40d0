package io.furrow.analytics.coverage;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.state.heap.HeapKeyedStateBackend;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedBroadcastOperatorTestHarness;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.FieldRecords;
import io.furrow.analytics.field.FieldVersions;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.BroadcastLatenessOperator;

import static org.assertj.core.api.Assertions.assertThat;

class CoverageStateTest {
    private static final long TIME_TO_LIVE = 3_600_000;
    private static final CoverageRules RULES = new CoverageRules(
            Double.NaN, 0.1, 10, Duration.ofSeconds(10), 0.5, Duration.ofSeconds(10), Duration.ofMillis(TIME_TO_LIVE));

    private final FieldRecords fields = new FieldRecords();

    /** {@link CoverField} alone. */
    private static final class Covering {
        private KeyedProcessOperator<String, Swath, CoverageReport> operator;
        private KeyedOneInputStreamOperatorTestHarness<String, Swath, CoverageReport> harness;

        Covering() throws Exception {
            begin();
            harness.open();
        }

        private void begin() throws Exception {
            operator = new KeyedProcessOperator<>(new CoverField(RULES));
            harness = new KeyedOneInputStreamOperatorTestHarness<>(operator, Swath::key, Types.STRING);
        }

        void restart() throws Exception {
            var state = harness.snapshot(1, 1);
            harness.close();
            begin();
            harness.initializeState(state);
            harness.open();
        }

        void receive(Swath swath) throws Exception {
            harness.processElement(new StreamRecord<>(swath, swath.time()));
        }

        List<CoverageReport> advance(long watermark) throws Exception {
            harness.processWatermark(new Watermark(watermark));
            List<CoverageReport> reports = new ArrayList<>(harness.extractOutputValues());
            harness.getOutput().clear();
            return reports;
        }

        int entries() {
            return ((HeapKeyedStateBackend<?>) operator.getKeyedStateBackend()).numKeyValueStateEntries();
        }

        int timers() {
            return harness.numEventTimeTimers();
        }

        void stop() throws Exception {
            harness.close();
        }
    }

    @Test
    void reportsTheSameHoweverOftenItRestartsAndForgetsAfterTheTimeToLive() throws Exception {
        List<Swath> swaths = CoveredCellsTest.swaths(new Drives(5));
        long end = swaths.get(swaths.size() - 1).time();
        Covering whole = new Covering();
        Covering parts = new Covering();
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
        Covering covering = new Covering();
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
        var operator = new BroadcastLatenessOperator<>(
                new BuildSwaths(RULES, new StoredFields(fields.all())), List.of(FieldVersions.BROADCAST));
        var harness = new KeyedBroadcastOperatorTestHarness<String, WorkReport, TopicRecord, Swath>(
                operator, WorkReport::key, Types.STRING, 16, 1, 0);
        harness.open();
        harness.processBroadcastWatermark(Watermark.MAX_WATERMARK);
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
        return new WorkReport(Drives.fix("r", mission, 10 + way, 10, time), 2, Work.ON);
    }
}
