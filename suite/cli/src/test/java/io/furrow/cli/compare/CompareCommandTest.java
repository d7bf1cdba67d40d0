package io.furrow.cli.compare;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.cli.control.StubControl;
import io.furrow.model.ngsi.Entity;

import static io.furrow.cli.compare.ResultRecords.average;
import static io.furrow.cli.compare.ResultRecords.encounter;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Compares results through a control plane. */
class CompareCommandTest {
    private static final String REPLAY = "data.weeding.replay.0000000a";
    /** A page of 1,000, which the stub leaves out at the end. */
    private static final String PAGE = "/records?values=true";

    @AutoClose
    private final StubControl control = new StubControl().answer("GET /api/v1/topics", """
                    [{'topic':'data.collision'},{'topic':'data.temperature'},{'topic':'%s'},{'topic':'%1$s.collision'},{'topic':'%1$s.temperature'}]""".formatted(REPLAY));

    @Test
    void comparesAllPagesOfAReplayWithThoseFoundLive() {
        answer(REPLAY + PAGE + "&limit=100", record(REPLAY, 7, "1", average("f", 0, 20, "good")));
        control.answerPage(
                "GET /api/v1/topics/" + REPLAY + ".collision" + PAGE,
                "[" + record(REPLAY, 9, "1", encounter("xy", "ended", 2, 0, 10)) + "]",
                "?values=true&limit=1000&before=x");
        answer(
                REPLAY + ".collision" + PAGE + "&limit=1000&before=x",
                record(REPLAY, 4, "1", encounter("ab", "ended", 3, 0, 10)),
                record(REPLAY, 3, "0", encounter("zz", "ended", 3, 0, 10)));
        answer("data.collision" + PAGE, record("data.collision", 1, null, encounter("xy", "ended", 2, 0, 10)));
        answer(REPLAY + ".temperature" + PAGE, record(REPLAY, 1, "1", average("f", 20, 19, "good")));
        String bounded = "&from=" + (ResultRecords.T0 + 10_000);
        // The newest record of a window is the first of the answer, and counts.
        answer(
                "data.temperature" + PAGE + "&limit=1000" + bounded,
                record("data.temperature", 6, null, average("f", 20, 19, "good")),
                record("data.temperature", 5, null, average("f", 20, 11, "good")));

        assertThat(compare(REPLAY, "live", "--from", Long.toString(ResultRecords.T0 + 10_000), "--to", "now"))
                .as(control.output())
                .isEqualTo(1);
        compare(REPLAY, "live", "--from", Long.toString(ResultRecords.T0 + 10_000), "--to", "now");

        assertThat(control.output())
                .contains("A  weeding.0000000a, epoch 1")
                .contains("ENCOUNTERS  1 same, 0 changed, 1 only in A, 0 only in B")
                .contains("AVERAGES  1 same, 0 changed");
    }

    @Test
    void reportsWhatCannotBeCompared() {
        assertThat(compare("weeding.0000000b", REPLAY)).isEqualTo(2);
        assertThat(control.output()).contains("There is no topic data.weeding.replay.0000000b");
        assertThat(compare(REPLAY, "live", "--from", "-5m")).isEqualTo(2);
        assertThat(control.output()).contains("there is no GET /api/v1/topics/" + REPLAY);
    }

    private int compare(String... arguments) {
        return control.run(java.util.stream.Stream.concat(
                        java.util.stream.Stream.of("replay", "compare"), java.util.stream.Stream.of(arguments))
                .toArray(String[]::new));
    }

    private void answer(String path, String... records) {
        control.answer("GET /api/v1/topics/" + path, "[" + String.join(",", records) + "]");
    }

    private static String record(String topic, long offset, String epoch, Entity entity) {
        return "{'topic':'%s','partition':0,'offset':%d,'headers':{%s},'value':%s}"
                .formatted(
                        topic,
                        offset,
                        epoch == null ? "" : "'replay-epoch':'%s'".formatted(epoch),
                        new String(entity.toBytes(), UTF_8));
    }
}
