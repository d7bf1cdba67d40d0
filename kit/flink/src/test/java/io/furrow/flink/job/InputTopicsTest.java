package io.furrow.flink.job;

import java.util.List;
import java.util.regex.Pattern;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class InputTopicsTest {
    private static final Pattern NORTH = new InputTopics(
                    List.of("data\\..*replay.*|data\\.north\\..*", "data.raw", "data.temperature"))
            .pattern()
            .orElseThrow();

    @Test
    void areNoPatternWhereAllAreTopics() {
        assertThat(new InputTopics(List.of("data.raw", "data.a_b-1")).pattern()).isEmpty();
    }

    @Test
    void areOneReplayOrLiveTopics() {
        String replay = "data.hoeing.replay.0a1b2c3d";
        assertThat(new InputTopics(List.of(replay)).replay()).contains(replay);
        assertThat(new InputTopics(List.of(replay, replay)).refusal("copy")).isEmpty();
        assertThat(new InputTopics(List.of(replay + ".collision", "data.raw")).replay())
                .as("what was found in it")
                .isEmpty();
        assertThat(new InputTopics(List.of("data.raw", "data[.].*")).refusal("copy"))
                .isEmpty();
        for (String other : List.of("data.raw", "data[.].*", "data.hoeing.replay.11111111")) {
            assertThat(new InputTopics(List.of(other, replay)).refusal("copy"))
                    .hasValueSatisfying(why -> assertThat(why).contains("'copy --input data."));
        }
        for (String pattern :
                List.of("data[.]hoeing[.]replay[.].*", "data\\.[^.]*\\.replay\\..*", "data.*.replay.0.*")) {
            assertThat(new InputTopics(List.of(pattern)).refusal("copy"))
                    .hasValueSatisfying(why -> assertThat(why).contains("'copy --input data.<mission>.replay.<id8>'"));
        }
    }

    @ParameterizedTest
    @CsvSource({
        "data.raw, true",
        "dataxraw, false",
        "data.hoeing.replay.0a1b2c3d, false",
        "data.south.realtime.replay, true",
        "data.hoeing.replay.0a1b2c3d.dead, false",
        "data.hoeing.replay.0a1b2c3d.collision, false",
        "data.hoeing.replay.0a1b2c3d.collision.late, false",
        "data.north.realtime, true",
        "data.north.realtime.temperature, true",
        "data.north.realtime.late, true",
        "data.north.realtime.hoeing.late, false",
        "data.hoeing.replay.0a1b2c3d.clocks, false",
        "data.north.realtime.clocks, true",
        "data.north.realtime.dead, false",
        "data.temperature, true",
        "data.presence, false",
        "data.north.layer, false",
        "other, false"
    })
    void takeWhatMatchesAndNothingThatAJobWrites(String topic, boolean taken) {
        assertThat(NORTH.matcher(topic).matches()).isEqualTo(taken);
    }
}
