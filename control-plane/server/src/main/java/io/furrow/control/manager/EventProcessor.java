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
 * Passes the records of a topic to an observer one by one, tombstones included, and notifies it that time passes. Each record is handled as
 * a whole or not at all; one that cannot be read or handled becomes a dead letter, so that it keeps no other from being handled.
 */
final class EventProcessor extends ContextualProcessor<String, byte[], String, OutputRecord> {
    private static final Logger LOG = LoggerFactory.getLogger(EventProcessor.class);
    private static final Duration TICK = Duration.ofSeconds(1);

    private final Function<UnitOfWork, ? extends Observer> opening;
    private final boolean first;
    private UnitOfWork unitOfWork;
    private Observer observer;

    /**
     * @param opening makes the observer, on the stores of the processor
     * @param first false beside another observer of the same records, which writes the dead letters of those that cannot be read
     */
    EventProcessor(Function<UnitOfWork, ? extends Observer> opening, boolean first) {
        this.opening = opening;
        this.first = first;
    }

    @Override
    public void init(ProcessorContext<String, OutputRecord> context) {
        super.init(context);
        unitOfWork = new UnitOfWork(context);
        observer = opening.apply(unitOfWork);
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
            LOG.debug("{} cannot be read", described(record), e);
            if (first) {
                setAside(record, e.reason(), e.getMessage());
            }
        } catch (OversizedRecordException e) {
            LOG.error("{} changed nothing", described(record), e);
            setAside(record, Reason.TOO_LARGE, e.getMessage());
        } catch (RuntimeException e) { // a fault of ours, which must not keep the other records from being handled
            LOG.error("{} failed and changed nothing", described(record), e);
            setAside(record, Reason.FAILED, FailureText.of(e));
        }
    }

    private String described(Record<String, byte[]> record) {
        return RecordOrigin.of(record)
                .map(RecordOrigin::toString)
                .orElseGet(() -> "a record of task " + context().taskId());
    }

    /** What is not a record of a topic, but was made of one, is in the log only. */
    private void setAside(Record<String, byte[]> record, Reason reason, String message) {
        RecordOrigin.of(record)
                .ifPresent(origin -> context().forward(DeadLetterRecords.of(record, origin, reason, message)));
    }
}
