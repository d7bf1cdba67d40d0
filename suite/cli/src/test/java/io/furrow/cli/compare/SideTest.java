package io.furrow.cli.compare;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.cli.option.CommandException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class SideTest {
    private static final List<String> TOPICS = List.of("""
                    data.collision data.weeding.replay.0a1b2c3d data.other.replay.00000001
                    data.gone.replay.00000002.collision""".split("\\s+"));

    @ParameterizedTest
    @CsvSource({
        "weeding.0a1b2c3d, data.weeding.replay.0a1b2c3d.collision",
        "data.weeding.replay.0a1b2c3d, data.weeding.replay.0a1b2c3d.collision",
        "gone.00000002, data.gone.replay.00000002.collision",
        "live, data.collision"
    })
    void findsTheTopicOfItsResults(String code, String topic) throws Exception {
        assertThat(Side.of(code, TOPICS).results(ResultKind.ENCOUNTERS)).isEqualTo(topic);
    }

    @Test
    void reportsThatThereIsNoSuchReplay() {
        assertThatThrownBy(() -> Side.of("weeding", TOPICS))
                .isInstanceOf(CommandException.class)
                .hasMessageContaining("name one as MISSION.ID");
        assertThatThrownBy(() -> Side.of("hoeing.00000001", TOPICS))
                .as("another of its group may have these digits")
                .isInstanceOf(CommandException.class)
                .hasMessageContaining("is named by it");
        assertThatThrownBy(() -> Side.of("weeding.ffffffff", TOPICS))
                .isInstanceOf(CommandException.class)
                .hasMessageContaining("There is no topic data.weeding.replay.ffffffff");
    }
}
