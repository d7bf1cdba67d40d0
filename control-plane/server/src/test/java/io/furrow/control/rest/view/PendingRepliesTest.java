package io.furrow.control.rest.view;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class PendingRepliesTest {
    private final PendingReplies answers = new PendingReplies();

    @Test
    void cachesAnswersPerManager() {
        answer(Topics.ALARM_MANAGER, "alarm-1");
        for (int i = 0; i <= PendingReplies.MAX_CACHED; i++) {
            answer(Topics.MISSION_MANAGER, "mission-" + i);
        }

        assertThat(isRemembered(Topics.ALARM_MANAGER, "alarm-1")).isTrue();
        assertThat(isRemembered(Topics.MISSION_MANAGER, "mission-0")).isFalse();
        assertThat(isRemembered(Topics.MISSION_MANAGER, "mission-1")).isTrue();
    }

    private void answer(String topic, String id) {
        CommandResult answer = CommandResult.of("created");
        answers.cache(new PendingReplies.Key(topic, id), "f", answer.toBytes(), answer);
    }

    private boolean isRemembered(String topic, String id) {
        return answers.find(new PendingReplies.Key(topic, id), "f").isPresent();
    }
}
