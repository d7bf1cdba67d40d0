package io.furrow.flink;

import java.util.List;
import java.util.regex.Pattern;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class InputTopicsTest {
    private static final Pattern REPLAYS = new InputTopics(List.of("data\\..*\\.replay\\..*", "data.raw"))
            .pattern()
            .orElseThrow();

    @Test
    void areNoPatternWhereAllAreTopics() {
        assertThat(new InputTopics(List.of("data.raw", "data.a_b-1")).pattern()).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({
        "data.raw, true",
        "dataxraw, false",
        "data.hoeing.replay.0a1b2c3d, true",
        "data.hoeing.replay.0a1b2c3d.dead, false",
        "data.hoeing.replay.0a1b2c3d.collision, false",
        "data.hoeing.replay.0a1b2c3d.collision.late, false",
        "other, false"
    })
    void takeWhatMatchesAndNothingThatAJobWrites(String topic, boolean taken) {
        assertThat(REPLAYS.matcher(topic).matches()).isEqualTo(taken);
    }
}
