package io.furrow.control.rest.view;

import java.util.ArrayDeque;
import java.util.HashMap;
import java.util.Map;
import java.util.Queue;
import java.util.concurrent.ExecutionException;
import java.util.function.ToLongFunction;

import org.apache.kafka.clients.admin.ListOffsetsResult.ListOffsetsResultInfo;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.InterruptException;

import io.furrow.model.control.CommandResult;

/**
 * Delays answers until the view has reached the end that the topics had when the answers were read, so that the view
 * shows their effects.
 */
final class ReadYourWritesBarrier {
    private final PendingReplies answers;
    private final Queue<HeldResponse> held = new ArrayDeque<>();

    private record HeldResponse(
            Map<PendingReplies.Key, CommandResult> answers,
            KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> ends) {}

    ReadYourWritesBarrier(PendingReplies answers) {
        this.answers = answers;
    }

    /** @param ends of the topics of the view, requested after the answers were read */
    void hold(
            Map<PendingReplies.Key, CommandResult> fresh,
            KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> ends) {
        held.add(new HeldResponse(fresh, ends));
    }

    boolean isEmpty() {
        return held.isEmpty();
    }

    /**
     * Releases, in order, the answers whose effects the view shows.
     *
     * @param position current position in a partition
     * @throws KafkaException if the ends could not be determined
     */
    void release(ToLongFunction<TopicPartition> position) {
        while (!held.isEmpty() && isVisible(held.peek(), position)) {
            held.remove().answers().forEach(answers::release);
        }
    }

    private static boolean isVisible(HeldResponse response, ToLongFunction<TopicPartition> position) {
        if (!response.ends().isDone()) {
            return false;
        }
        try {
            Map<TopicPartition, Long> ends = new HashMap<>();
            response.ends().get().forEach((partition, end) -> ends.put(partition, end.offset()));
            return reached(ends, position);
        } catch (ExecutionException e) {
            throw new KafkaException("the ends of the control plane's topics are not known", e.getCause());
        } catch (InterruptedException e) {
            throw new InterruptException(e);
        }
    }

    static boolean reached(Map<TopicPartition, Long> ends, ToLongFunction<TopicPartition> position) {
        return ends.entrySet().stream().allMatch(end -> position.applyAsLong(end.getKey()) >= end.getValue());
    }
}
