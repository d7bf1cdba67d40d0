package io.furrow.control.rest.view;

import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import org.apache.kafka.clients.admin.ListOffsetsResult.ListOffsetsResultInfo;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.internals.KafkaFutureImpl;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ReadYourWritesBarrierTest {
    private static final TopicPartition MISSIONS = new TopicPartition(Topics.MISSIONS, 0);

    private final PendingReplies answers = new PendingReplies();
    private final ReadYourWritesBarrier barrier = new ReadYourWritesBarrier(answers);
    private final Map<TopicPartition, Long> positions = new HashMap<>(Map.of(MISSIONS, 4L));
    private final KafkaFutureImpl<Map<TopicPartition, ListOffsetsResultInfo>> ends = new KafkaFutureImpl<>();

    @Test
    void holdsAnAnswerUntilTheViewHasCaughtUp() {
        CompletableFuture<CommandResult> waiting = held("r-1", ends);
        barrier.release(positions::get);
        assertThat(waiting).isNotDone();

        ends.complete(Map.of(MISSIONS, new ListOffsetsResultInfo(5, 0, Optional.empty())));
        barrier.release(positions::get);
        assertThat(waiting).isNotDone();

        positions.put(MISSIONS, 5L);
        barrier.release(positions::get);
        assertThat(waiting)
                .isCompletedWithValueMatching(answer -> answer.status().equals("created"));
        assertThat(barrier.isEmpty()).isTrue();
    }

    @Test
    void releasesAnswersInOrder() {
        CompletableFuture<CommandResult> first = held("r-1", ends);
        CompletableFuture<CommandResult> second = held("r-2", KafkaFuture.completedFuture(Map.of()));
        barrier.release(positions::get);
        assertThat(second).isNotDone();

        ends.complete(Map.of());
        barrier.release(positions::get);
        assertThat(first).isDone();
        assertThat(second).isDone();
    }

    @Test
    void failsIfTheEndsAreUnknown() {
        held("r-1", ends);
        ends.completeExceptionally(new KafkaException("away"));

        assertThatThrownBy(() -> barrier.release(positions::get))
                .isInstanceOf(KafkaException.class)
                .hasMessageContaining("are not known");
    }

    private CompletableFuture<CommandResult> held(
            String id, KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> future) {
        PendingReplies.Key key = new PendingReplies.Key(Topics.MISSION_MANAGER, id);
        CompletableFuture<CommandResult> waiting = new CompletableFuture<>();
        answers.await(key, new PendingReplies.PendingRequest("", waiting));
        barrier.hold(Map.of(key, CommandResult.of("created")), future);
        return waiting;
    }
}
