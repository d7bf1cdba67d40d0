package io.furrow.control.manager;

import java.util.function.BiFunction;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.ngsi.UnreadableException;

/**
 * Processes the statuses that hosts and players report. What cannot be read or handled changes nothing and becomes a
 * dead letter; a record without a value says nothing.
 */
public final class StatusProcessor extends ContextualProcessor<String, byte[], String, OutputRecord> {
    private final BiFunction<ProcessorContext<?, ?>, EventPublisher, StatusHandler> opening;
    private AtomicHandler atomic;
    private StatusHandler reports;

    /** Who takes them. */
    public interface StatusHandler {
        /** @param now epoch ms */
        void take(String key, byte[] value, long now) throws UnreadableException;
    }

    /** @param opening makes who takes them, whose stores are those of the context */
    public StatusProcessor(BiFunction<ProcessorContext<?, ?>, EventPublisher, StatusHandler> opening) {
        this.opening = opening;
    }

    @Override
    public void init(ProcessorContext<String, OutputRecord> context) {
        super.init(context);
        atomic = new AtomicHandler(true, context);
        reports = opening.apply(atomic.context(), CommandProcessor.publisher(atomic.context()));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        if (record.value() != null && record.key() != null) {
            atomic.run(
                    record,
                    () -> reports.take(record.key(), record.value(), context().currentSystemTimeMs()));
        }
    }
}
