package io.furrow.control.manager;

import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.apache.kafka.streams.state.KeyValueStore;

/**
 * Copies a compacted topic into a global store, which every instance holds completely.
 *
 * <p><b>State</b>: newest value by key. <b>Cleared</b>: by a tombstone. <b>Emits</b>: nothing; records without a key
 * are skipped.
 */
final class GlobalStoreProcessor extends ContextualProcessor<String, byte[], Void, Void> {
    private final String name;
    private KeyValueStore<String, byte[]> store;

    GlobalStoreProcessor(String name) {
        this.name = name;
    }

    @Override
    public void init(ProcessorContext<Void, Void> context) {
        super.init(context);
        store = context.getStateStore(name);
    }

    @Override
    public void process(Record<String, byte[]> record) {
        if (record.key() != null) {
            store.put(record.key(), record.value());
        }
    }
}
