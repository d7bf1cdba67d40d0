package io.furrow.control.manager;

import java.util.HashSet;
import java.util.Set;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.state.KeyValueStore;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.StateJson;

/**
 * Forwards each record of a topic once, even if the topic, or its repartition topic, is read again from an older
 * offset: the offsets of a group expire after {@code offsets.retention.minutes}, and a killed broker may return offsets
 * of some minutes ago. So no old request is executed again, and no ended encounter raises a second alarm.
 *
 * <p><b>State</b>: offset and newest timestamp by partition of the topic, in a named store. <b>Cleared</b>: never; its
 * size is bounded by the number of partitions. <b>Duplicates</b>: dropped if neither offset nor timestamp is new; a
 * recreated topic has old offsets, but new timestamps.
 */
final class DeduplicationProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(DeduplicationProcessor.class);

    private final String store;
    /** Partitions whose last record was skipped, so that this is logged once. */
    private final Set<String> rereadPartitions = new HashSet<>();

    private KeyValueStore<String, byte[]> positions;

    /**
     * The position in a partition.
     *
     * @param newest timestamp, epoch ms
     */
    record Position(long offset, long newest) {
        boolean covers(long other, long timestamp) {
            return other <= offset && timestamp <= newest;
        }

        Position with(Position later) {
            return new Position(later.offset, Math.max(newest, later.newest));
        }
    }

    DeduplicationProcessor(String store) {
        this.store = store;
    }

    @Override
    public void init(ProcessorContext<String, byte[]> context) {
        super.init(context);
        positions = context.getStateStore(store);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        RecordOrigin origin = RecordOrigin.of(record)
                .orElseThrow(() -> new IllegalStateException(
                        "a record has no origin; RequestProcessor or SourcePositionProcessor adds it"));
        String partition = origin.topicPartition();
        byte[] stored = positions.get(partition);
        Position existing = stored == null ? null : StateJson.read(stored, Position.class);
        if (existing != null && existing.covers(origin.offset(), record.timestamp())) {
            if (rereadPartitions.add(partition)) {
                LOG.warn("{} is read again; records up to {}@{} are skipped", origin, partition, existing.offset());
            }
            return;
        }
        rereadPartitions.remove(partition);
        Position now = new Position(origin.offset(), record.timestamp());
        positions.put(partition, StateJson.write(existing == null ? now : existing.with(now)));
        context().forward(record);
    }
}
