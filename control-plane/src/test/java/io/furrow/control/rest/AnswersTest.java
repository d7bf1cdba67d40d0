package io.furrow.control.rest;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.Response;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class AnswersTest {
    private final Answers answers = new Answers();

    @Test
    void remembersTheAnswersOfAManagerHoweverManyAnotherGives() {
        answer(Topics.ALARM_MANAGER, "alarm-1");
        for (int i = 0; i <= Answers.REMEMBERED; i++) {
            answer(Topics.MISSION_MANAGER, "mission-" + i);
        }

        assertThat(isKnown(Topics.ALARM_MANAGER, "alarm-1")).isTrue();
        assertThat(isKnown(Topics.MISSION_MANAGER, "mission-0")).isFalse();
        assertThat(isKnown(Topics.MISSION_MANAGER, "mission-1")).isTrue();
    }

    private void answer(String topic, String id) {
        Response answer = Response.of("created");
        answers.remember(new Answers.Key(topic, id), "f", answer.toBytes(), answer);
    }

    private boolean isKnown(String topic, String id) {
        return answers.known(new Answers.Key(topic, id), "f").isPresent();
    }
}
