package io.furrow.ingest.latest;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.apache.flink.streaming.util.KeyedOneInputStreamOperatorTestHarness;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class MergeLatestTest {
    private static final Duration KEPT = Duration.ofMillis(1000);

    @AutoClose
    private KeyedOneInputStreamOperatorTestHarness<String, ReportedEvent, TopicRecord> operator;

    @BeforeEach
    void open() throws Exception {
        create(LatestKey.ID);
        operator.open();
    }

    @Test
    void mergesAttributeByAttribute() throws Exception {
        report(100, robot().number("speed", 1).number("fuel", 50));
        report(200, robot().number("speed", 2));

        assertThat(values()).containsExactly("""
                {"id":"robot","type":"Robot","fuel":{"type":"Float","value":50.0,"metadata":{}},"speed":{"type":"Float",\
                "value":1.0,"metadata":{}}}""", """
                {"id":"robot","type":"Robot","fuel":{"type":"Float","value":50.0,"metadata":{}},"speed":{"type":"Float",\
                "value":2.0,"metadata":{}}}""");
    }

    @Test
    void neverGoesBackInEventTime() throws Exception {
        report(200, robot().number("speed", 2));
        report(100, robot().number("speed", 1));
        report(150, robot().number("speed", 1).number("fuel", 50));

        assertThat(operator.extractOutputValues())
                .as("the event of 100 brings nothing new")
                .hasSize(2);
        Entity newest = Entity.parse(last().value());
        assertThat(newest.number("speed")).contains(2.0);
        assertThat(newest.number("fuel")).contains(50.0);
        assertThat(last().timestamp()).isEqualTo(200);
        assertThat(last().headers())
                .containsEntry(HeaderNames.TS_DEVICE, "200")
                .containsEntry(HeaderNames.CE_TIME, "1970-01-01T00:00:00.200Z")
                .containsEntry(HeaderNames.CE_ID, "e150");
    }

    @Test
    void forgetsTheOldestOfMoreAttributesThanADeviceHas() throws Exception {
        report(100, robot().number("speed", 1));
        for (int run = 0; run < 1_010; run++) {
            report(200 + run, robot().number("run-" + run, run));
        }

        Entity newest = Entity.parse(last().value());
        assertThat(newest.attributes()).hasSize(1_000);
        assertThat(newest.number("speed")).isEmpty();
        assertThat(newest.number("run-9")).isEmpty();
        assertThat(newest.number("run-10")).contains(10.0);
        assertThat(newest.number("run-1009")).contains(1009.0);
    }

    @Test
    void takesTheLaterToComeOfTwoOfOneTime() throws Exception {
        report(100, robot().number("speed", 1));
        report(100, robot().number("speed", 2));

        assertThat(Entity.parse(last().value()).number("speed")).contains(2.0);
    }

    @Test
    void keepsANumberDigitForDigitAndATextSignForSign() throws Exception {
        String reported =
                "{\"id\":\"robot\",\"type\":\"Robot\",\"a \\\"quote\":{\"type\":\"Number\",\"value\":1.10,\"metadata\":{}},"
                        + "\"n\":{\"type\":\"Number\",\"value\":123456789012345678901234567890,\"metadata\":{}},"
                        + "\"t\":{\"type\":\"Text\",\"value\":\"\\u0000 ñ 🚜\",\"metadata\":{}}}";
        event(100, reported.getBytes(UTF_8));

        assertThat(Entity.parse(last().value())).isEqualTo(Entity.parse(reported.getBytes(UTF_8)));
        assertThat(values().get(0)).contains("\"value\":1.10,");
    }

    @Test
    void endsWithTheDeletionAndLeavesNoState() throws Exception {
        report(100, robot().number("speed", 1));
        event(200, null);

        assertThat(last().value()).isNull();
        assertThat(last().key()).isEqualTo("robot".getBytes(UTF_8));
        operator.processWatermark(1199);
        assertThat(operator.numKeyedStateEntries())
                .as("older events may still come")
                .isEqualTo(1);
        operator.processWatermark(1200);
        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();
    }

    @Test
    void isNotBroughtBackByWhatIsOlderThanItsDeletion() throws Exception {
        report(100, robot().number("speed", 1));
        event(200, null);
        report(150, robot().number("speed", 1));
        assertThat(operator.extractOutputValues()).hasSize(2);

        report(201, robot().number("fuel", 50));

        assertThat(Entity.parse(last().value()).value("speed"))
                .as("what it was before")
                .isEmpty();
        assertThat(Entity.parse(last().value()).number("fuel")).contains(50.0);
        operator.processWatermark(5000);
        assertThat(operator.numKeyedStateEntries()).as("it is alive").isEqualTo(1);
    }

    @Test
    void isNotEndedByADeletionThatIsOlderThanWhatIsKnown() throws Exception {
        report(200, robot().number("speed", 1));
        event(100, null);

        assertThat(operator.extractOutputValues()).hasSize(1);
    }

    @Test
    void isEndedByADeletionThatFollowsReportsOfAClockThatIsAhead() throws Exception {
        report(160, 100, robot().number("speed", 1));
        event(105, null);

        assertThat(last().value()).isNull();
        assertThat(last().timestamp()).as("nothing older brings it back").isEqualTo(160);
    }

    @Test
    void isNotEndedByADeletionBeforeItCameBackWithAClockThatWasSetBack() throws Exception {
        report(160, 100, robot().number("speed", 1));
        report(110, 110, robot().number("fuel", 50));
        event(105, null);

        assertThat(operator.extractOutputValues()).hasSize(2).noneMatch(record -> record.value() == null);
    }

    @Test
    void remembersAcrossARestart() throws Exception {
        report(200, robot().number("speed", 2));
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        create(LatestKey.ID);
        operator.initializeState(snapshot);
        operator.open();

        report(100, robot().number("speed", 1).number("fuel", 50));

        assertThat(Entity.parse(last().value()).number("speed")).contains(2.0);
        assertThat(Entity.parse(last().value()).number("fuel")).contains(50.0);
    }

    @Test
    void isCompactedByIdentityWhereTenantsShareIds() throws Exception {
        operator.close();
        create(LatestKey.IDENTITY);
        operator.open();
        report(100, robot().number("speed", 1));

        assertThat(last().key()).isEqualTo("farm|/|robot".getBytes(UTF_8));
    }

    @Test
    void remembersADeletionAsLongAsItIsToldTo() throws Exception {
        event(200, null);
        OperatorSubtaskState snapshot = operator.snapshot(1, 1);
        operator.close();
        create(LatestKey.ID, Duration.ofMillis(3000));
        operator.initializeState(snapshot);
        operator.open();
        operator.processWatermark(3199);

        report(150, robot().number("speed", 1));

        assertThat(operator.extractOutputValues()).as("older than the deletion").isEmpty();
        operator.processWatermark(3200);
        assertThat(operator.numKeyedStateEntries()).isZero();
        assertThat(operator.numEventTimeTimers()).isZero();
    }

    private void create(LatestKey key) throws Exception {
        create(key, KEPT);
    }

    private void create(LatestKey key, Duration deletionMemory) throws Exception {
        operator = new KeyedOneInputStreamOperatorTestHarness<>(
                new MergeLatestOperator(
                        new MergeLatest(deletionMemory, key), key, TopicSnapshot.NONE, Duration.ofHours(1)),
                ReportedEvent::identity,
                Types.STRING);
    }

    private static EntityBuilder robot() {
        return Entity.builder("robot", "Robot");
    }

    private void report(long time, EntityBuilder entity) throws Exception {
        report(time, time, entity);
    }

    private void report(long time, long received, EntityBuilder entity) throws Exception {
        event(time, received, entity.build().toBytes());
    }

    private void event(long time, byte[] value) throws Exception {
        event(time, time, value);
    }

    private void event(long time, long received, byte[] value) throws Exception {
        Map<String, String> headers = Map.of(
                HeaderNames.CE_ID, "e" + time,
                HeaderNames.TS_DEVICE, Long.toString(time),
                HeaderNames.TS_SOURCE, Long.toString(received));
        TopicRecord record = TopicRecord.of("data.raw", time, "robot", value, headers);
        operator.processElement(new ReportedEvent("e" + time, "farm|/|robot", "robot", "Robot", "", "", record), time);
    }

    private TopicRecord last() {
        List<TopicRecord> written = operator.extractOutputValues();
        return written.get(written.size() - 1);
    }

    private List<String> values() {
        return operator.extractOutputValues().stream()
                .map(record -> new String(record.value(), UTF_8))
                .toList();
    }
}
