package io.furrow.analytics.position;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.streaming.util.ProcessFunctionTestHarnesses;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.ReportedRun;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.flink.time.ClockSkewLimit;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ReadPositionsTest {
    private static EntityBuilder placed() {
        return Entity.builder("r1", "ROBOT").number("Latitude", 40.5).number("Longitude", -3.25);
    }

    @Test
    void takesWhoItIsWhereItIsAndHowItMoves() throws Exception {
        assertThat(read(placed().text("Mission", "hoeing")
                        .text("carriedBy", "t1")
                        .number("speed", 1.5)
                        .number("heading", 270)))
                .containsExactly(new PositionFix(
                        "data.raw",
                        "farm|/|ROBOT|r1",
                        "r1",
                        "ROBOT",
                        "hoeing",
                        "farm|/|t1",
                        40.5,
                        -3.25,
                        1.5,
                        270,
                        1000));
    }

    @Test
    void takesSpeedAndHeadingThatAreMissingOrCannotBeForUnknown() throws Exception {
        assertThat(read(placed())).singleElement().satisfies(ReadPositionsTest::movesUnknown);
        assertThat(read(placed().number("speed", -1).number("heading", 361)))
                .singleElement()
                .satisfies(ReadPositionsTest::movesUnknown);
    }

    /** Metadata says in which unit it is; the page shows the same. */
    @Test
    void readsTheSpeedInItsUnit() throws Exception {
        byte[] robot = """
                {"id":"r1","type":"Robot","Latitude":{"value":1},"Longitude":{"value":2},
                 "speed":{"value":36,"metadata":{"unitCode":{"type":"Text","value":"KMH"}}}}""".getBytes(UTF_8);

        assertThat(read(robot)).extracting(PositionFix::speed).containsExactly(10.0);
    }

    private static void movesUnknown(PositionFix fix) {
        assertThat(fix.speed()).isNaN();
        assertThat(fix.heading()).isNaN();
    }

    @Test
    void setsAsideAnEndOfAnEpochThatCannotBeRead() throws Exception {
        var harness = ProcessFunctionTestHarnesses.forProcessFunction(
                new ReadPositions("collision", ClockSkewLimit.of(ReportedRun.options())));
        Map<String, String> headers = Map.of(HeaderNames.REPLAY_KIND, "end", HeaderNames.REPLAY_EPOCH, "none");
        harness.processElement(
                new TopicRecord("data.hoeing.replay.0a1b2c3d", 0, 7, 1000, new byte[0], new byte[0], headers), 1000);

        assertThat(harness.getSideOutput(DeadLetters.TAG))
                .singleElement()
                .satisfies(letter ->
                        assertThat(letter.getValue().headers()).containsEntry(DeadLetter.REASON, "not-an-event"));
        harness.close();
    }

    @Test
    void takesNoPositionThatIsOfALaterTimeThanTheEvent() throws Exception {
        assertThat(read(placed(), Map.of(HeaderNames.LATER_ATTRIBUTES, "temp"))).hasSize(1);
        assertThat(read(placed(), Map.of(HeaderNames.LATER_ATTRIBUTES, "temp,Longitude")))
                .isEmpty();
    }

    private static List<PositionFix> read(EntityBuilder entity) throws Exception {
        return read(entity, Map.of());
    }

    private static List<PositionFix> read(EntityBuilder entity, Map<String, String> others) throws Exception {
        return read(entity.build().toBytes(), others);
    }

    private static List<PositionFix> read(byte[] value) throws Exception {
        return read(value, Map.of());
    }

    private static List<PositionFix> read(byte[] value, Map<String, String> others) throws Exception {
        ClockSkewLimit ahead = ClockSkewLimit.of(ReportedRun.options());
        var harness = ProcessFunctionTestHarnesses.forProcessFunction(new ReadPositions("collision", ahead));
        byte[] key = "r1".getBytes(UTF_8);
        Map<String, String> headers = new HashMap<>(others);
        headers.putAll(Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/"));
        harness.processElement(new TopicRecord("data.raw", 0, 7, 1000, key, value, headers), 1000);
        List<PositionFix> fixes = harness.extractOutputValues();
        harness.close();
        return fixes;
    }
}
