package io.furrow.model.topic;

import java.util.Optional;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class TopicsTest {
    @ParameterizedTest
    @CsvSource({
        "data.hoeing.replay.0a1b2c3d, true, true, hoeing.0a1b2c3d",
        "data.hoeing.replay.0a1b2c3d.collision, false, true,",
        "data.hoeing.replay.0a1b2c, false, false,",
        "data.replay.realtime, false, false,",
        "data.raw, false, false,"
    })
    void detectsTopicsOfReplays(String topic, boolean isReplay, boolean isOfReplay, String replay) {
        assertThat(Topics.isReplay(topic)).isEqualTo(isReplay);
        assertThat(Topics.isOfReplay(topic)).isEqualTo(isOfReplay);
        assertThat(Topics.replayOf(topic)).isEqualTo(Optional.ofNullable(replay));
    }

    @ParameterizedTest
    @CsvSource({
        "data.raw, data.collision, data.collision",
        "data.farm.realtime.hoeing, data.collision, data.collision",
        "data.hoeing.replay.0a1b2c3d, data.collision, data.hoeing.replay.0a1b2c3d.collision",
        "data.hoeing.replay.0a1b2c3d, data.collision.late, data.hoeing.replay.0a1b2c3d.collision.late",
        "data.hoeing.replay.0a1b2c3d, alarms, data.hoeing.replay.0a1b2c3d.alarms",
        "data.hoeing.replay.0a1b2c3d.collision, data.collision, data.collision"
    })
    void writesResultsOfAReplayToItsOwnTopics(String input, String output, String expected) {
        assertThat(Topics.resultOf(input, output)).isEqualTo(expected);
    }
}
