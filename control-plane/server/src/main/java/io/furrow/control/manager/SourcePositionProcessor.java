package io.furrow.control.manager;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.Record;

/** Adds the origin to the headers of each record, for dead letters; records of a punctuation have none. */
final class SourcePositionProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    @Override
    public void process(Record<String, byte[]> record) {
        boolean hasOrigin = context().recordMetadata().isPresent();
        context().forward(hasOrigin ? RecordOrigin.of(context()).addTo(record) : record);
    }
}
