package io.furrow.soak.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;

import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;
import io.furrow.soak.CommittedState;

/** Reads the committed answers of all managers from the beginning, also after outages of Kafka. */
final class AnswerLog implements AutoCloseable {
    static final List<String> MANAGERS =
            List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER, Topics.REPLAY_MANAGER, Topics.ALARM_MANAGER);
    private static final Duration POLL = Duration.ofMillis(50);

    private final Map<String, List<CommandResult>> answers = new ConcurrentHashMap<>();
    private final String bootstrapServers;
    private final Thread thread = new Thread(this::readTopics, "answers");
    private volatile boolean closed;

    /** The topics must exist. */
    AnswerLog(String bootstrapServers) {
        this.bootstrapServers = bootstrapServers;
        thread.setDaemon(true);
        thread.start();
    }

    /** All answers by the id of their request, in the order of the topic. */
    Map<String, List<CommandResult>> answers() {
        return answers;
    }

    /** All answers to a request so far. */
    List<CommandResult> to(String requestId) {
        return answers.getOrDefault(requestId, List.of());
    }

    private void readTopics() {
        try (KafkaConsumer<String, byte[]> consumer = CommittedState.consumer(bootstrapServers)) {
            CommittedState.assign(consumer, MANAGERS);
            while (!closed) {
                consumer.poll(POLL).forEach(this::add);
            }
        }
    }

    private void add(ConsumerRecord<String, byte[]> record) {
        try {
            CommandResult answer = CommandResult.read(record.value());
            answer.requestId().ifPresent(id -> answers.merge(id, List.of(answer), AnswerLog::joined));
        } catch (UnreadableException e) {
            // a request
        }
    }

    private static List<CommandResult> joined(List<CommandResult> some, List<CommandResult> others) {
        List<CommandResult> all = new ArrayList<>(some);
        all.addAll(others);
        return all;
    }

    @Override
    public void close() {
        closed = true;
    }
}
