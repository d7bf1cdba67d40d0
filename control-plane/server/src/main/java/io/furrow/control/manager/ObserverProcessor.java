package io.furrow.control.manager;

import java.time.Duration;
import java.util.List;
import java.util.function.BiFunction;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;

import io.furrow.model.ngsi.UnreadableException;

/**
 * Passes records of other parts of Furrow to an observer, tombstones included, and notifies it that time passes. What
 * cannot be read or handled changes nothing and becomes a dead letter.
 */
public final class ObserverProcessor extends ContextualProcessor<String, byte[], String, OutputRecord> {
    private static final Duration TICK = Duration.ofSeconds(1);

    private final BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening;
    private final boolean first;
    private AtomicHandler atomic;
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

    private ObserverProcessor(
            BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening, boolean first) {
        this.opening = opening;
        this.first = first;
    }

    /** @param opening makes the observer, whose stores are those of the context */
    public ObserverProcessor(BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening) {
        this(opening, true);
    }

    /** The same beside another observer of the same records, which writes the dead letters of what cannot be read. */
    public static ObserverProcessor besideAnother(
            BiFunction<ProcessorContext<String, OutputRecord>, EventPublisher, Observer> opening) {
        return new ObserverProcessor(opening, false);
    }

    @Override
    public void init(ProcessorContext<String, OutputRecord> context) {
        super.init(context);
        atomic = new AtomicHandler(first, context);
        observer = opening.apply(atomic.context(), CommandProcessor.publisher(atomic.context()));
        Punctuations punctuations = new Punctuations(atomic.context());
        context.schedule(
                TICK, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(List.of(() -> observer.passTime(now))));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        atomic.run(record, () -> observer.take(record, context().currentSystemTimeMs()));
    }
}
