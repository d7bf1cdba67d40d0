package io.furrow.control.manager;

import java.time.Duration;
import java.util.function.BiFunction;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.UnreadableException;

/**
 * Shows an observer what other parts of Furrow wrote, deletions too, and lets it know that time passes. What cannot be read
 * is passed over with a warning: it is the business of whoever wrote it.
 */
public final class ObserveRecords extends ContextualProcessor<String, byte[], String, Outgoing> {
    private static final Logger LOG = LoggerFactory.getLogger(ObserveRecords.class);
    private static final Duration TICK = Duration.ofSeconds(1);

    private final BiFunction<ProcessorContext<String, Outgoing>, Outbox, Observer> opening;
    private Observer observer;

    /** Who is shown them. */
    public interface Observer {
        /**
         * @param record whose key may be empty and whose value is null for a deletion
         * @param now epoch ms
         */
        void take(Record<String, byte[]> record, long now) throws UnreadableException;

        /** Called about once a second. */
        default void passTime(long now) {}
    }

    /** @param opening makes the observer, whose stores are those of the context */
    public ObserveRecords(BiFunction<ProcessorContext<String, Outgoing>, Outbox, Observer> opening) {
        this.opening = opening;
    }

    @Override
    public void init(ProcessorContext<String, Outgoing> context) {
        super.init(context);
        observer = opening.apply(context, AnswerRequests.outbox(context));
        context.schedule(TICK, PunctuationType.WALL_CLOCK_TIME, observer::passTime);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        try {
            observer.take(record, context().currentSystemTimeMs());
        } catch (UnreadableException e) {
            LOG.warn("a record with the key {} is passed over: {}", record.key(), e.getMessage());
        }
    }
}
