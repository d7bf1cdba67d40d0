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
 * Forwards each record of a topic once, also where the topic, or the repartition topic behind it, is read again from
 * an older offset: a group that was unavailable for {@code offsets.retention.minutes} has none, and a broker that was
 * killed may hand out offsets of some minutes ago. No request of last week is run again, and no encounter that has
 * ended raises a second alarm.
 *
 * <p><b>State</b>: offset and newest timestamp by partition of the topic, in a named store. <b>Cleared</b>: never, it is as large as there are
 * partitions. <b>Twice</b>: dropped where neither the offset nor the timestamp is new; a topic that was deleted and made again
 * has old offsets, but new timestamps.
 */
final class DeduplicationProcessor extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(DeduplicationProcessor.class);

    private final String store;
    /** Partitions of which the last record was skipped, so that the log reports it once. */
    private final Set<String> readAgain = new HashSet<>();

    private KeyValueStore<String, byte[]> positions;

    /**
     * How far a partition was read.
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

    /** @param store of the positions */
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
            if (readAgain.add(partition)) {
                LOG.warn("{} is read again; records up to {}@{} are skipped", origin, partition, existing.offset());
            }
            return;
        }
        readAgain.remove(partition);
        Position now = new Position(origin.offset(), record.timestamp());
        positions.put(partition, StateJson.write(existing == null ? now : existing.with(now)));
        context().forward(record);
    }
}
