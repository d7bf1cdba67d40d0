package io.furrow.flink.record;

import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.flink.time.ReplayKind;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.UnreadableException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EpochsTest {
    private static final long TIME = 1_700_000_000_123L;
    private static final String REPLAY = "data.hoeing.replay.0a1b2c3d";

    @Test
    void leaveTheTimesOfLiveTopicsAlone() throws Exception {
        TopicRecord live = record("data.replay.realtime", TIME, Map.of(HeaderNames.REPLAY_EPOCH, "3"));

        assertThat(Epochs.timeOf(live)).isEqualTo(TIME);
        assertThat(Epochs.originalTimeOf(live)).isEqualTo(TIME);
        assertThat(Epochs.original(TIME)).isEqualTo(TIME);
        assertThat(Epochs.original(-5)).isEqualTo(-5);
        assertThat(Epochs.begin(TIME)).isZero();
        assertThat(Epochs.text(TIME)).isEqualTo("1700000000123");
        assertThat(Epochs.isOver(TIME, TIME + 1_000_000_000_000L)).isFalse();
    }

    @Test
    void comeAfterEachOtherWhateverTheirTimes() throws Exception {
        TopicRecord first = record(REPLAY, TIME, Map.of());
        TopicRecord again =
                record(REPLAY, TIME, Map.of(HeaderNames.REPLAY_EPOCH, "1", HeaderNames.REPLAY_OFFSET, "123"));
        TopicRecord last = record(REPLAY, 0, Map.of(HeaderNames.REPLAY_EPOCH, Long.toString(Epochs.LAST)));

        assertThat(Epochs.timeOf(first)).as("a replay that says nothing").isEqualTo(TIME);
        long time = Epochs.timeOf(again);
        assertThat(time).isGreaterThan(Epochs.timeOf(first)).isLessThan(Epochs.timeOf(last));
        assertThat(Epochs.original(time)).isEqualTo(TIME - 123).isEqualTo(Epochs.originalTimeOf(again));
        assertThat(Epochs.of(time)).isEqualTo(1);
        assertThat(Epochs.begin(time) + TIME - 123).isEqualTo(time);
        assertThat(Epochs.text(time)).isEqualTo("1700000000000:1");
        assertThat(Epochs.isOver(TIME, time)).isTrue();
        assertThat(Epochs.isOver(TIME, Epochs.end(0))).isTrue();
        assertThat(Epochs.isOver(time, Epochs.end(0))).isFalse();
        assertThat(Epochs.of(Epochs.timeOf(last))).isEqualTo(Epochs.LAST);
    }

    @ParameterizedTest
    @CsvSource({
        "replay-epoch, one, replay-epoch is not a number",
        "replay-epoch, -1, replay-epoch is not between 0 and 262143",
        "replay-epoch, 262144, replay-epoch is not between 0 and 262143",
        "replay-offset, 1700000000124, the timestamp 1700000000123 less replay-offset is not between 0 and 17592186044416",
        "replay-kind, pause, 'replay-kind must be event, prime or end'"
    })
    void refuseHeadersThatTellNoTime(String header, String text, String message) {
        TopicRecord record = record(REPLAY, TIME, Map.of(header, text));

        assertThatThrownBy(() -> {
                    Epochs.timeOf(record);
                    ReplayKind.of(record);
                })
                .isInstanceOf(UnreadableException.class)
                .hasMessage(message);
    }

    private static TopicRecord record(String topic, long timestamp, Map<String, String> headers) {
        return TopicRecord.of(topic, timestamp, "r", new byte[0], headers);
    }
}
