package io.furrow.control.manager;

import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/**
 * Handles records one by one, each as a whole or not at all; one that cannot be read or handled becomes a dead letter, so that it
 * keeps no other from being handled.
 */
final class AtomicHandler {
    private static final Logger LOG = LoggerFactory.getLogger(AtomicHandler.class);

    private final boolean deadLettersForUnreadable;
    private final ProcessorContext<String, OutputRecord> direct;
    private final UnitOfWork unitOfWork;

    /** What is done with a record. */
    interface Handler {
        void handle() throws UnreadableException;
    }

    /** @param deadLettersForUnreadable whether what cannot be read becomes a dead letter here; false if somebody else sees to that */
    AtomicHandler(boolean deadLettersForUnreadable, ProcessorContext<String, OutputRecord> context) {
        this.deadLettersForUnreadable = deadLettersForUnreadable;
        this.direct = context;
        this.unitOfWork = new UnitOfWork(context);
    }

    /** That of the handlers: their stores, and where they write to. */
    UnitOfWork context() {
        return unitOfWork;
    }

    void run(Record<String, byte[]> record, Handler handler) {
        try {
            unitOfWork.call(() -> {
                handler.handle();
                return null;
            });
        } catch (UnreadableException e) {
            LOG.debug("{} cannot be read", described(record), e);
            if (deadLettersForUnreadable) {
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
                .orElseGet(() -> "a record of task " + direct.taskId());
    }

    /** What is no record of a topic, but was made of one, is in the log only. */
    private void setAside(Record<String, byte[]> record, Reason reason, String message) {
        RecordOrigin.of(record)
                .ifPresent(origin -> direct.forward(DeadLetterRecords.of(record, origin, reason, message)));
    }
}
