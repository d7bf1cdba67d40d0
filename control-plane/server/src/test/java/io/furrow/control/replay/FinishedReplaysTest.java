package io.furrow.control.replay;

import java.util.Optional;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.record.TimestampType;
import org.junit.jupiter.api.Test;

import io.furrow.control.replay.FinishedReplays.Remains;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class FinishedReplaysTest {
    private static final String NAME = "m.0a1b2c3d";
    private static final String TOPIC = "data.show.replay.0a1b2c3d";

    private final FinishedReplays remains = new FinishedReplays();

    private void take(String topic, String key, byte[] value, long timestamp) {
        remains.take(new ConsumerRecord<>(
                topic,
                0,
                0,
                timestamp,
                TimestampType.CREATE_TIME,
                0,
                0,
                key,
                value,
                new RecordHeaders(),
                Optional.empty()));
    }

    private void desired(String mission, String topic) {
        take(
                Topics.REPLAYS,
                mission + ".0a1b2c3d",
                DesiredReplay.started(mission, topic, ReplayPlan.PLAIN, 1, 0, 1).toBytes(),
                0);
    }

    private void status(ReplayStatus.State state, boolean settled, long timestamp) {
        take(Topics.REPLAYS_STATUS, NAME, new ReplayStatus(1, state, null, settled, null).toBytes(), timestamp);
    }

    @Test
    void areThoseOfAReplayThatIsOverForGoodAndNotDesired() {
        desired("m", TOPIC);
        status(ReplayStatus.State.RUNNING, false, 50);
        status(ReplayStatus.State.ENDED, false, 60);
        assertThat(remains.overBy(1000)).isEmpty();
        status(ReplayStatus.State.ENDED, true, 100);
        assertThat(remains.overBy(1000)).as("still wanted").isEmpty();
        take(Topics.REPLAYS, NAME, null, 110);
        assertThat(remains.overBy(99)).as("within the grace period").isEmpty();
        assertThat(remains.overBy(100)).containsExactly(new Remains(NAME, TOPIC));
        take(Topics.REPLAYS_STATUS, NAME, null, 200);
        assertThat(remains.overBy(1000)).isEmpty();
    }

    @Test
    void areNoneWhereTheReplayWasStartedAnew() {
        status(ReplayStatus.State.ENDED, true, 100);
        desired("m", TOPIC);
        assertThat(remains.overBy(1000)).isEmpty();
        take(Topics.REPLAYS, NAME, null, 0);
        status(ReplayStatus.State.RUNNING, false, 200);
        assertThat(remains.overBy(1000)).isEmpty();
    }

    @Test
    void areNoneWhereAnotherReplayHasTheTopic() {
        desired("m", TOPIC);
        take(Topics.REPLAYS, NAME, null, 0);
        status(ReplayStatus.State.STOPPED, true, 100);
        desired("n", TOPIC);
        assertThat(remains.overBy(1000)).isEmpty();
        take(Topics.REPLAYS, "n.0a1b2c3d", null, 0);
        assertThat(remains.overBy(1000)).hasSize(1);
    }

    @Test
    void areNoneWhileAnotherReplayOfTheTopicIsOverForLessLong() {
        desired("m", TOPIC);
        take(Topics.REPLAYS, NAME, null, 0);
        status(ReplayStatus.State.STOPPED, true, 100);
        desired("n", TOPIC);
        take(Topics.REPLAYS, "n.0a1b2c3d", null, 0);
        ReplayStatus later = new ReplayStatus(1, ReplayStatus.State.ENDED, null, true, null);
        take(Topics.REPLAYS_STATUS, "n.0a1b2c3d", later.toBytes(), 900);

        assertThat(remains.overBy(500)).isEmpty();
        assertThat(remains.overBy(900)).hasSize(2);
    }

    @Test
    void haveTheTopicThatIsCalledAfterTheReplayWhereNothingElseIsKnown() {
        status(ReplayStatus.State.FAILED, true, 100);
        assertThat(remains.overBy(100)).containsExactly(new Remains(NAME, "data.m.replay.0a1b2c3d"));
    }

    @Test
    void areNoneWhereTheStatusCannotBeRead() {
        status(ReplayStatus.State.FAILED, true, 100);
        take(Topics.REPLAYS_STATUS, NAME, new byte[] {1}, 200);
        assertThat(remains.overBy(1000)).isEmpty();
    }
}
