package io.furrow.control.manager;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.Record;

/** Notes on each record where it stood, so that a dead letter of it can say so; what a punctuation made stood nowhere. */
final class SourcePositionProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    @Override
    public void process(Record<String, byte[]> record) {
        boolean stood = context().recordMetadata().isPresent();
        context().forward(stood ? RecordOrigin.of(context()).noteOn(record) : record);
    }
}
