package io.furrow.control.replay;

import java.util.Optional;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.record.TimestampType;
import org.junit.jupiter.api.Test;

import io.furrow.control.replay.FinishedReplays.Replay;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class FinishedReplaysTest {
    private static final String NAME = "m.0a1b2c3d";
    private static final String TOPIC = "data.show.replay.0a1b2c3d";

    private final FinishedReplays finished = new FinishedReplays();

    private void take(String topic, String key, byte[] value, long timestamp) {
        finished.take(new ConsumerRecord<>(
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
    void containsAReplayThatIsFinallyOverAndNotDesired() {
        desired("m", TOPIC);
        status(ReplayStatus.State.RUNNING, false, 50);
        status(ReplayStatus.State.ENDED, false, 60);
        assertThat(finished.finishedBy(1000)).isEmpty();
        status(ReplayStatus.State.ENDED, true, 100);
        assertThat(finished.finishedBy(1000)).as("still desired").isEmpty();
        take(Topics.REPLAYS, NAME, null, 110);
        assertThat(finished.finishedBy(99)).as("within the grace period").isEmpty();
        assertThat(finished.finishedBy(100)).containsExactly(new Replay(NAME, TOPIC));
        take(Topics.REPLAYS_STATUS, NAME, null, 200);
        assertThat(finished.finishedBy(1000)).isEmpty();
    }

    @Test
    void excludesARestartedReplay() {
        status(ReplayStatus.State.ENDED, true, 100);
        desired("m", TOPIC);
        assertThat(finished.finishedBy(1000)).isEmpty();
        take(Topics.REPLAYS, NAME, null, 0);
        status(ReplayStatus.State.RUNNING, false, 200);
        assertThat(finished.finishedBy(1000)).isEmpty();
    }

    @Test
    void excludesATopicOfAnotherReplay() {
        desired("m", TOPIC);
        take(Topics.REPLAYS, NAME, null, 0);
        status(ReplayStatus.State.STOPPED, true, 100);
        desired("n", TOPIC);
        assertThat(finished.finishedBy(1000)).isEmpty();
        take(Topics.REPLAYS, "n.0a1b2c3d", null, 0);
        assertThat(finished.finishedBy(1000)).hasSize(1);
    }

    @Test
    void waitsForTheLastReplayOfATopic() {
        desired("m", TOPIC);
        take(Topics.REPLAYS, NAME, null, 0);
        status(ReplayStatus.State.STOPPED, true, 100);
        desired("n", TOPIC);
        take(Topics.REPLAYS, "n.0a1b2c3d", null, 0);
        ReplayStatus later = new ReplayStatus(1, ReplayStatus.State.ENDED, null, true, null);
        take(Topics.REPLAYS_STATUS, "n.0a1b2c3d", later.toBytes(), 900);

        assertThat(finished.finishedBy(500)).isEmpty();
        assertThat(finished.finishedBy(900)).hasSize(2);
    }

    @Test
    void assumesTheDefaultTopicWithoutARecord() {
        status(ReplayStatus.State.FAILED, true, 100);
        assertThat(finished.finishedBy(100)).containsExactly(new Replay(NAME, "data.m.replay.0a1b2c3d"));
    }

    @Test
    void excludesAReplayWithAnUnreadableStatus() {
        status(ReplayStatus.State.FAILED, true, 100);
        take(Topics.REPLAYS_STATUS, NAME, new byte[] {1}, 200);
        assertThat(finished.finishedBy(1000)).isEmpty();
    }
}
