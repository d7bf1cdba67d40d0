package io.furrow.model.topic;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TopicRulesTest {
    @ParameterizedTest
    @CsvSource({
        "data.raw, true, false", "data.farm.realtime.weeding, true, false",
        "data.raw.dead, false, false", "data.m.replay.0a1b2c3d.collision, true, false",
        "service.missionmanager, true, true", "service.audit, true, false",
        "__consumer_offsets, false, false", "mydata.raw, false, false"
    })
    void allowsByDefaultToReadDataAndControlTopicsAndToWriteRequests(String topic, boolean read, boolean write) {
        assertThat(TopicRules.DEFAULT.mayRead(topic)).isEqualTo(read);
        assertThat(TopicRules.DEFAULT.mayWrite(topic)).isEqualTo(write);
    }

    @Test
    void treatsAStarAsWildcardAndAllElseLiterally() {
        TopicRules rules = new TopicRules(List.of("data.*.realtime"), List.of());

        assertThat(rules.mayRead("data.farm.realtime")).isTrue();
        assertThat(rules.mayRead("dataXfarm.realtime")).isFalse();
        assertThat(rules.mayRead("data.farm.realtime.m")).isFalse();
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "a b", "a/b", "data.[a-z]"})
    void rejectsPatternsThatMatchNoTopic(String pattern) {
        assertThatThrownBy(() -> new TopicRules(List.of(pattern), List.of()))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("'" + pattern + "' names no topics");
    }
}
