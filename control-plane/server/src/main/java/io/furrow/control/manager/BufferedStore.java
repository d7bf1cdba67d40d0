package io.furrow.control.manager;

import java.util.Iterator;
import java.util.List;
import java.util.Map;
import java.util.NoSuchElementException;
import java.util.TreeMap;

import org.apache.kafka.streams.KeyValue;
import org.apache.kafka.streams.processor.StateStore;
import org.apache.kafka.streams.processor.StateStoreContext;
import org.apache.kafka.streams.state.KeyValueIterator;
import org.apache.kafka.streams.state.KeyValueStore;

/** A store whose writes are seen by its own reads, and reach the store behind it with {@link #apply}. */
final class BufferedStore implements KeyValueStore<String, byte[]> {
    private final KeyValueStore<String, byte[]> store;
    /** By key; null for what is deleted. */
    private final Map<String, byte[]> staged = new TreeMap<>();

    BufferedStore(KeyValueStore<String, byte[]> store) {
        this.store = store;
    }

    /** @throws OversizedRecordException where a value is larger than a changelog takes */
    void check() {
        staged.forEach((key, value) -> OversizedRecordException.check(store.name(), key, value));
    }

    public void apply() {
        staged.forEach(store::put);
        staged.clear();
    }

    void discard() {
        staged.clear();
    }

    @Override
    public byte[] get(String key) {
        return staged.containsKey(key) ? staged.get(key) : store.get(key);
    }

    @Override
    public void put(String key, byte[] value) {
        staged.put(key, value);
    }

    @Override
    public byte[] putIfAbsent(String key, byte[] value) {
        byte[] existing = get(key);
        if (existing == null) {
            put(key, value);
        }
        return existing;
    }

    @Override
    public void putAll(List<KeyValue<String, byte[]>> entries) {
        entries.forEach(entry -> put(entry.key, entry.value));
    }

    @Override
    public byte[] delete(String key) {
        byte[] existing = get(key);
        put(key, null);
        return existing;
    }

    @Override
    public KeyValueIterator<String, byte[]> all() {
        return staged.isEmpty() ? store.all() : merged(store.all());
    }

    @Override
    public KeyValueIterator<String, byte[]> range(String from, String to) {
        throw new UnsupportedOperationException("read all of " + name());
    }

    private KeyValueIterator<String, byte[]> merged(KeyValueIterator<String, byte[]> stored) {
        Map<String, byte[]> all = new TreeMap<>();
        try (stored) {
            stored.forEachRemaining(entry -> all.put(entry.key, entry.value));
        }
        all.putAll(staged);
        all.values().removeIf(value -> value == null);
        return new Entries(all.entrySet().iterator());
    }

    @Override
    public long approximateNumEntries() {
        return store.approximateNumEntries() + staged.size();
    }

    @Override
    public String name() {
        return store.name();
    }

    @Override
    public void init(StateStoreContext context, StateStore root) {
        throw new UnsupportedOperationException(name() + " is initialized by Kafka Streams");
    }

    @Override
    public void flush() {
        throw new UnsupportedOperationException(name() + " is flushed by Kafka Streams");
    }

    @Override
    public void close() {
        throw new UnsupportedOperationException(name() + " is closed by Kafka Streams");
    }

    @Override
    public boolean persistent() {
        return store.persistent();
    }

    @Override
    public boolean isOpen() {
        return store.isOpen();
    }

    private static final class Entries implements KeyValueIterator<String, byte[]> {
        private final Iterator<Map.Entry<String, byte[]>> entries;
        private Map.Entry<String, byte[]> next;

        Entries(Iterator<Map.Entry<String, byte[]>> entries) {
            this.entries = entries;
        }

        @Override
        public boolean hasNext() {
            return next != null || entries.hasNext();
        }

        @Override
        public KeyValue<String, byte[]> next() {
            peekNextKey();
            KeyValue<String, byte[]> entry = KeyValue.pair(next.getKey(), next.getValue());
            next = null;
            return entry;
        }

        @Override
        public String peekNextKey() {
            if (!hasNext()) {
                throw new NoSuchElementException();
            }
            next = next == null ? entries.next() : next;
            return next.getKey();
        }

        @Override
        public void close() {
            // Nothing is held open.
        }
    }
}
