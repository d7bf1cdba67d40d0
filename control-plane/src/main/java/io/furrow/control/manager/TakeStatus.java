package io.furrow.control.manager;

import java.nio.charset.StandardCharsets;
import java.util.function.BiFunction;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Takes what executors say of what is. What cannot be read becomes a dead letter; a record without a value says
 * nothing.
 */
public final class TakeStatus extends ContextualProcessor<String, byte[], String, Outgoing> {
    private final String topic;
    private final BiFunction<ProcessorContext<?, ?>, Outbox, Reports> opening;
    private Reports reports;

    /** Who takes them. */
    public interface Reports {
        /** @param now epoch ms */
        void take(String key, byte[] value, long now) throws UnreadableException;
    }

    /** @param opening makes who takes them, whose stores are those of the context */
    public TakeStatus(String topic, BiFunction<ProcessorContext<?, ?>, Outbox, Reports> opening) {
        this.topic = topic;
        this.opening = opening;
    }

    @Override
    public void init(ProcessorContext<String, Outgoing> context) {
        super.init(context);
        reports = opening.apply(context, AnswerRequests.outbox(context));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        if (record.value() == null || record.key() == null) {
            return;
        }
        try {
            reports.take(record.key(), record.value(), context().currentSystemTimeMs());
        } catch (UnreadableException e) {
            context().forward(letter(record, e));
        }
    }

    private Record<String, Outgoing> letter(Record<String, byte[]> record, UnreadableException e) {
        Outgoing letter = new Outgoing(Topics.dead(topic), record.value());
        Record<String, Outgoing> dead = new Record<>(record.key(), letter, record.timestamp(), record.headers());
        new DeadLetter(e.reason(), e.getMessage(), "control-plane", topic)
                .headers()
                .forEach((name, value) -> dead.headers().add(name, value.getBytes(StandardCharsets.UTF_8)));
        return dead;
    }
}
