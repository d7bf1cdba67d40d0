package io.furrow.control.manager;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Lets each request pass once, also where Kafka has forgotten how far its topic, or the line behind it, was read, as it does with
 * the offsets of a group that was away for {@code offsets.retention.minutes}: no request of last week is run again.
 *
 * <p><b>State</b>: offset and newest timestamp by partition of the topic, in a named store. <b>Cleared</b>: never, it is as large as there are
 * partitions. <b>Twice</b>: dropped where neither the offset nor the timestamp is new; a topic that was deleted and made anew
 * has old offsets, but new timestamps.
 */
final class TakeOnce extends ContextualProcessor<String, byte[], String, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(TakeOnce.class);

    private final ManagerTopic<?> manager;
    private Records<Position> positions;

    /**
     * How far a partition was read.
     *
     * @param newest timestamp, epoch ms
     */
    record Position(long offset, long newest) {
        boolean covers(long other, long timestamp) {
            return other <= offset && timestamp <= newest;
        }

        Position with(long other, long timestamp) {
            return new Position(other, Math.max(newest, timestamp));
        }
    }

    TakeOnce(ManagerTopic<?> manager) {
        this.manager = manager;
    }

    @Override
    public void init(ProcessorContext<String, byte[]> context) {
        super.init(context);
        positions = StoreRecords.of(context, manager.positions(), Position.class);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        RecordOrigin origin = RecordOrigin.of(record)
                .orElseThrow(() -> new IllegalStateException("a request has no origin; AcceptRequests notes it"));
        Position known = positions.get(origin.topicPartition());
        if (known != null && known.covers(origin.offset(), record.timestamp())) {
            LOG.warn("{} was read before and is passed over", origin);
            return;
        }
        Position now = new Position(origin.offset(), record.timestamp());
        positions.put(origin.topicPartition(), known == null ? now : known.with(origin.offset(), record.timestamp()));
        context().forward(record);
    }
}
