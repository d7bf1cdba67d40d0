package io.furrow.analytics.clock;

import java.time.Duration;
import java.util.Map;
import java.util.function.LongUnaryOperator;

import com.fasterxml.jackson.databind.node.TextNode;
import org.apache.flink.streaming.api.operators.ProcessOperator;
import org.apache.flink.streaming.util.OneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

/** No watermark comes: event time stands still. */
class ReportDelayedDevicesTest {
    private static final long START = 1_700_000_000_000L;
    private static final long SECOND = 1_000;
    private static final long MINUTE = 60 * SECOND;
    private static final long HOUR = 60 * MINUTE;

    @AutoClose
    private OneInputStreamOperatorTestHarness<TopicRecord, ClockReport> harness;

    private long now = START;

    @BeforeEach
    void start() throws Exception {
        harness = new OneInputStreamOperatorTestHarness<>(new ProcessOperator<>(
                new ReportDelayedDevices(new ReceiptTime(Duration.ofSeconds(10)), Duration.ofMinutes(1))));
        harness.open();
    }

    @Test
    void reportsAThermometerThatIsTwoHoursBehindWithinAMinuteAndThenOnceAMinute() throws Exception {
        for (int second = 0; second < 100; second++) {
            report("slow", now - 2 * HOUR);
            report("right", now);
            now += SECOND;
        }
        assertThat(harness.extractOutputValues())
                .extracting(
                        ClockReport::kind,
                        ClockReport::id,
                        ClockReport::mission,
                        ClockReport::millis,
                        ClockReport::positions,
                        ClockReport::time)
                .containsExactly(
                        tuple(ClockReport.Kind.DELAYED, "slow", "m", 2 * HOUR, 31, START + 30 * SECOND),
                        tuple(ClockReport.Kind.DELAYED, "slow", "m", 2 * HOUR, 91, START + 90 * SECOND));
    }

    @Test
    void reportsOneThatReportsEveryHalfMinuteAfterAMinute() throws Exception {
        assertThat(reports(30 * SECOND, 3, time -> time - START)).isEqualTo(1);
    }

    @Test
    void reportsOneThatReportsEveryQuarterOfAnHour() throws Exception {
        assertThat(reports(15 * MINUTE, 4, time -> time - 2 * HOUR)).isEqualTo(2);
        assertThat(harness.extractOutputValues())
                .extracting(ClockReport::interval)
                .containsExactly(15 * MINUTE, 15 * MINUTE);
    }

    @Test
    void endsAStreakWithALongSilence() throws Exception {
        assertThat(reports(4 * HOUR, 10, time -> time - 2 * HOUR)).isZero();
    }

    @Test
    void reportsAClockThatWentWrongMeanwhileAndNoneThatIsRightNowAndThen() throws Exception {
        assertThat(reports(SECOND, 60, time -> time)).isZero();
        assertThat(reports(SECOND, 60, time -> time - (time / SECOND % 20 == 0 ? 0 : HOUR)))
                .isZero();
        assertThat(reports(SECOND, 60, time -> time - HOUR)).isEqualTo(1);
    }

    @Test
    void reportsNoneThatSendsWhatItStored() throws Exception {
        assertThat(reports(SECOND, 140, time -> START - 2 * HOUR + (time - START) * 50))
                .isZero();
    }

    @Test
    void countsNoReportTwiceNorWhatIsReplayedRepairedOrAResult() throws Exception {
        assertThat(reports(10 * SECOND, 60, time -> START - HOUR))
                .as("the context broker notifies of an entity to which a command was sent")
                .isZero();
        for (int i = 0; i < 60; i++) {
            now += SECOND;
            TopicRecord slow = record("slow", now - HOUR);
            receive(slow.to("data.m.replay.0a1b2c3d"));
            receive(slow.with(HeaderNames.ORIGIN, "repair"));
            report("Analytics:FieldTemperature:f", now - HOUR);
        }
        assertThat(harness.extractOutputValues()).isEmpty();
    }

    @Test
    void reportsAClockThatStandsStill() throws Exception {
        for (long behind : new long[] {365 * 24 * HOUR, 2 * MINUTE}) {
            int before = harness.extractOutputValues().size();
            long still = now - behind;
            for (int i = 0; i < 10; i++) {
                receive(measured("robot " + behind, still, i));
                now += 10 * SECOND;
            }
            assertThat(harness.extractOutputValues()).hasSizeGreaterThan(before);
        }
    }

    @Test
    void countsNoCommandNorTheSameMeasurementTwiceAsOneOfAClockThatStandsStill() throws Exception {
        long still = START - HOUR;
        for (int i = 0; i < 10; i++) {
            now += 10 * SECOND;
            Entity commanded = Entity.builder("robot", "Thermometer")
                    .text("TimeInstant", "2023-11-14T22:13:%02dZ".formatted(i))
                    .text("Mission", "m" + i)
                    .text("cmd", "go " + i)
                    .attribute("water", "command", TextNode.valueOf("go " + i))
                    .attribute("water_info", "commandResult", TextNode.valueOf("gone " + i))
                    .integer("Temperature", 1)
                    .build();
            receive(record(commanded, still));
        }
        TopicRecord first = measured("robot", still, 2);
        for (int i = 0; i < 10; i++) {
            receive(first);
            receive(measured("robot", still, 3));
        }
        assertThat(harness.extractOutputValues()).isEmpty();
    }

    @Test
    void reportsADeviceThoughAnotherOfItsIdIsRight() throws Exception {
        for (int second = 0; second < 40; second++) {
            receive(record("one", "Robot", now));
            receive(record("one", "Thermometer", now - HOUR));
            receive(record("one", "Station", now - 2 * HOUR));
            now += SECOND;
        }
        assertThat(harness.extractOutputValues())
                .extracting(ClockReport::type, ClockReport::millis)
                .containsExactlyInAnyOrder(tuple("Thermometer", HOUR), tuple("Station", 2 * HOUR));
    }

    private int reports(long period, int times, LongUnaryOperator clock) throws Exception {
        int before = harness.extractOutputValues().size();
        for (int i = 0; i < times; i++) {
            report("slow", clock.applyAsLong(now));
            now += period;
        }
        return harness.extractOutputValues().size() - before;
    }

    private void report(String device, long time) throws Exception {
        receive(record(device, time));
    }

    private void receive(TopicRecord record) throws Exception {
        harness.processElement(record, record.timestamp());
    }

    private TopicRecord record(String device, long time) {
        return record(device, "Thermometer", time);
    }

    private TopicRecord record(String device, String type, long time) {
        return record(Entity.builder(device, type).text("Mission", "m").build(), time);
    }

    private TopicRecord measured(String device, long time, int value) {
        return record(
                Entity.builder(device, "Thermometer")
                        .integer("Temperature", value)
                        .build(),
                time);
    }

    private TopicRecord record(Entity entity, long time) {
        Map<String, String> headers = Map.of(HeaderNames.TS_SOURCE, Long.toString(now));
        return TopicRecord.of("data.raw", time, entity.id(), entity.toBytes(), headers);
    }
}
