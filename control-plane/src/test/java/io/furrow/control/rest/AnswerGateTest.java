package io.furrow.control.rest;

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

import io.furrow.model.control.Response;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AnswerGateTest {
    private static final TopicPartition MISSIONS = new TopicPartition(Topics.MISSIONS, 0);

    private final Answers answers = new Answers();
    private final AnswerGate gate = new AnswerGate(answers);
    private final Map<TopicPartition, Long> positions = new HashMap<>(Map.of(MISSIONS, 4L));
    private final KafkaFutureImpl<Map<TopicPartition, ListOffsetsResultInfo>> ends = new KafkaFutureImpl<>();

    @Test
    void holdsAnAnswerUntilTheViewIsAsFarAsTheTopicsWere() {
        CompletableFuture<Response> waiting = held("r-1", ends);
        gate.release(positions::get);
        assertThat(waiting).isNotDone();

        ends.complete(Map.of(MISSIONS, new ListOffsetsResultInfo(5, 0, Optional.empty())));
        gate.release(positions::get);
        assertThat(waiting).isNotDone();

        positions.put(MISSIONS, 5L);
        gate.release(positions::get);
        assertThat(waiting)
                .isCompletedWithValueMatching(answer -> answer.status().equals("created"));
        assertThat(gate.isEmpty()).isTrue();
    }

    @Test
    void handsAnswersOnInOrder() {
        CompletableFuture<Response> first = held("r-1", ends);
        CompletableFuture<Response> second = held("r-2", KafkaFuture.completedFuture(Map.of()));
        gate.release(positions::get);
        assertThat(second).isNotDone();

        ends.complete(Map.of());
        gate.release(positions::get);
        assertThat(first).isDone();
        assertThat(second).isDone();
    }

    @Test
    void failsWhereTheEndsCannotBeHad() {
        held("r-1", ends);
        ends.completeExceptionally(new KafkaException("away"));

        assertThatThrownBy(() -> gate.release(positions::get))
                .isInstanceOf(KafkaException.class)
                .hasMessageContaining("are not known");
    }

    private CompletableFuture<Response> held(
            String id, KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> future) {
        Answers.Key key = new Answers.Key(Topics.MISSION_MANAGER, id);
        CompletableFuture<Response> waiting = new CompletableFuture<>();
        answers.await(key, new Answers.Awaited("", waiting));
        gate.hold(Map.of(key, Response.of("created")), future);
        return waiting;
    }
}
