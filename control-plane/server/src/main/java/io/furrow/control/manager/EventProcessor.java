package io.furrow.control.manager;

import java.time.Duration;
import java.util.List;
import java.util.function.Function;

import org.apache.kafka.streams.processor.PunctuationType;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/**
 * Passes the records of a topic to an observer, including tombstones, and notifies it about the passing of time. Each
 * record is handled atomically; one that cannot be read or handled becomes a dead letter, so that it does not block
 * others.
 */
final class EventProcessor extends ContextualProcessor<String, byte[], String, OutputRecord> {
    private static final Logger LOG = LoggerFactory.getLogger(EventProcessor.class);
    private static final Duration TICK = Duration.ofSeconds(1);

    private final Function<UnitOfWork, ? extends Observer> observerFactory;
    private final boolean writesUnreadable;
    private UnitOfWork unitOfWork;
    private Observer observer;

    /**
     * @param observerFactory creates the observer on the stores of the processor
     * @param writesUnreadable whether unreadable records become dead letters; false if another observer of the same
     *     records writes them
     */
    EventProcessor(Function<UnitOfWork, ? extends Observer> observerFactory, boolean writesUnreadable) {
        this.observerFactory = observerFactory;
        this.writesUnreadable = writesUnreadable;
    }

    @Override
    public void init(ProcessorContext<String, OutputRecord> context) {
        super.init(context);
        unitOfWork = new UnitOfWork(context);
        observer = observerFactory.apply(unitOfWork);
        Punctuations punctuations = new Punctuations(unitOfWork, context.taskId());
        context.schedule(
                TICK, PunctuationType.WALL_CLOCK_TIME, now -> punctuations.run(List.of(() -> observer.passTime(now))));
    }

    @Override
    public void process(Record<String, byte[]> record) {
        try {
            unitOfWork.call(() -> {
                observer.take(record, unitOfWork.now());
                return null;
            });
        } catch (UnreadableException e) {
            LOG.debug("{} cannot be read", describe(record), e);
            if (writesUnreadable) {
                deadLetter(record, e.reason(), e.getMessage());
            }
        } catch (OversizedRecordException e) {
            LOG.error("{} changed nothing", describe(record), e);
            deadLetter(record, Reason.TOO_LARGE, e.getMessage());
        } catch (RuntimeException e) { // a bug must not block the other records
            LOG.error("{} failed and changed nothing", describe(record), e);
            deadLetter(record, Reason.FAILED, FailureText.of(e));
        }
    }

    private String describe(Record<String, byte[]> record) {
        return RecordOrigin.of(record)
                .map(RecordOrigin::toString)
                .orElseGet(() -> "a record of task " + context().taskId());
    }

    /** Writes a dead letter. A derived record without an origin is only logged. */
    private void deadLetter(Record<String, byte[]> record, Reason reason, String message) {
        RecordOrigin.of(record)
                .ifPresent(origin -> context().forward(DeadLetterRecords.of(record, origin, reason, message)));
    }
}
