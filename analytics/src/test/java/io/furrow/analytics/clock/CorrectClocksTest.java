package io.furrow.analytics.clock;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.api.operators.KeyedProcessOperator;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.ReceiptTime;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class CorrectClocksTest {
    private static final long START = 1_700_000_000_000L;
    private static final long SECOND = 1000;

    private KeyedOneInputStreamOperatorTestHarness<String, TopicRecord, TopicRecord> harness;

    @BeforeEach
    void start() throws Exception {
        harness = harness();
        harness.open();
    }

    @AfterEach
    void leaveNothing() throws Exception {
        harness.processWatermark(new Watermark(START + Duration.ofDays(3).toMillis()));
        assertThat(harness.numKeyedStateEntries()).isZero();
        assertThat(harness.numEventTimeTimers()).isZero();
        harness.close();
    }

    @Test
    void givesADeviceTheTimesOfAClockThatIsRightAndLeavesOthersAlone() throws Exception {
        for (long now = START; now < START + 200 * SECOND; now += SECOND) {
            receive(record("slow", now - 3000, now));
            receive(record("right", now - 100, now));
        }
        List<TopicRecord> out = harness.extractOutputValues();
        assertThat(out).hasSize(400);
        assertThat(out)
                .filteredOn(record -> key(record).equals("right"))
                .allMatch(record -> record.timestamp() == received(record) - 100)
                .noneMatch(record -> record.headers().containsKey(CorrectClocks.HEADER));
        assertThat(out)
                .filteredOn(record -> key(record).equals("slow") && received(record) >= START + 122 * SECOND)
                .hasSize(78)
                .allMatch(record -> record.timestamp() == received(record))
                .allMatch(record -> "3000".equals(record.headers().get(CorrectClocks.HEADER)));
        assertThat(reports())
                .containsExactly(new ClockReport(
                        ClockReport.Kind.OFFSET,
                        "data.raw",
                        "farm|/|slow",
                        "slow",
                        "",
                        "",
                        3000,
                        0,
                        0,
                        START + 122 * SECOND));
    }

    @Test
    void goesOnAfterARestartAsWithoutOne() throws Exception {
        List<String> undisturbed = run(-1);
        for (int restart : List.of(1, 60, 119, 120, 121, 122, 180)) {
            harness.close();
            start();
            assertThat(run(restart)).isEqualTo(undisturbed);
        }
    }

    @Test
    void correctsEachEntityOfAnIdByItsOwnClock() throws Exception {
        for (long now = START; now < START + 20 * SECOND; now += SECOND) {
            receive(record(entity("7", "Robot"), "7", now, now));
            receive(record(entity("7", "WeatherStation"), "7", now + 300 * SECOND, now));
        }
        List<TopicRecord> out = harness.extractOutputValues();
        assertThat(out)
                .filteredOn(record -> new String(record.value(), UTF_8).contains("Robot"))
                .hasSize(20)
                .allMatch(record -> record.timestamp() == received(record))
                .noneMatch(record -> record.headers().containsKey(CorrectClocks.HEADER));
        assertThat(out)
                .filteredOn(record -> new String(record.value(), UTF_8).contains("WeatherStation"))
                .hasSize(20)
                .filteredOn(record -> received(record) >= START + 2 * SECOND)
                .allMatch(record -> record.timestamp() == received(record))
                .allMatch(record -> "-300000".equals(record.headers().get(CorrectClocks.HEADER)));
        assertThat(reports())
                .extracting(ClockReport::type, ClockReport::millis)
                .containsExactly(tuple("WeatherStation", -300_000L));
    }

    private List<String> run(int restartedAfter) throws Exception {
        List<TopicRecord> out = new ArrayList<>();
        for (int second = 0; second < 200; second++) {
            long now = START + second * SECOND;
            receive(record("slow", now - 3000 - second * 7 % 11, now));
            if (second == restartedAfter) {
                out.addAll(harness.extractOutputValues());
                OperatorSubtaskState snapshot = harness.snapshot(1, 1);
                harness.close();
                harness = harness();
                harness.initializeState(snapshot);
                harness.open();
            }
        }
        out.addAll(harness.extractOutputValues());
        return out.stream()
                .map(record -> record.timestamp() + " " + record.headers().get(CorrectClocks.HEADER))
                .toList();
    }

    @Test
    void leavesAsItIsWhatItKnowsNoReceiptOfAndWhatIsNoDevices() throws Exception {
        long beyond = System.currentTimeMillis() + Duration.ofHours(2).toMillis();
        List<TopicRecord> records = new ArrayList<>();
        for (long now = START; now < START + 200 * SECOND; now += SECOND) {
            TopicRecord slow = record("slow", now - 3000, now);
            records.add(slow.to("data.hoeing.replay.0a1b2c3d").with(HeaderNames.ORIGIN, "replay"));
            records.add(TopicRecord.of("data.raw", now - 3000, "slow", slow.value(), Map.of()));
            records.add(record("slow", now - 3000, beyond));
            records.add(record("Analytics:FieldTemperature:f", now - 60_000, now));
            records.add(record("", now - 60_000, now));
            records.add(slow.withValue(null));
        }
        for (TopicRecord record : records) {
            receive(record);
        }
        assertThat(harness.extractOutputValues()).isEqualTo(records);
        assertThat(reports()).isEmpty();
    }

    private static KeyedOneInputStreamOperatorTestHarness<String, TopicRecord, TopicRecord> harness() throws Exception {
        CorrectClocks correct = new CorrectClocks(new ReceiptTime(Duration.ofSeconds(10)));
        return new KeyedOneInputStreamOperatorTestHarness<>(
                new KeyedProcessOperator<>(correct), CorrectClocks::deviceOf, Types.STRING);
    }

    private void receive(TopicRecord record) throws Exception {
        harness.processElement(record, record.timestamp());
    }

    private List<ClockReport> reports() {
        var side = harness.getSideOutput(CorrectClocks.REPORTS);
        return side == null
                ? List.of()
                : side.stream().map(StreamRecord::getValue).toList();
    }

    private static TopicRecord record(String device, long time, long received) {
        return record(new byte[] {1}, device, time, received);
    }

    private static byte[] entity(String id, String type) {
        return Entity.builder(id, type).build().toBytes();
    }

    private static TopicRecord record(byte[] value, String device, long time, long received) {
        Map<String, String> headers = Map.of(
                HeaderNames.SERVICE, "farm",
                HeaderNames.SERVICE_PATH, "/",
                HeaderNames.TS_SOURCE, Long.toString(received));
        return TopicRecord.of("data.raw", time, device, value, headers);
    }

    private static String key(TopicRecord record) {
        return new String(record.key(), UTF_8);
    }

    private static long received(TopicRecord record) {
        return Long.parseLong(record.headers().get(HeaderNames.TS_SOURCE));
    }
}
