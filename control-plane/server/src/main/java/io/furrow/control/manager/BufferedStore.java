package io.furrow.control.manager;

import java.util.Map;
import java.util.TreeMap;
import java.util.function.Consumer;

import org.apache.kafka.streams.state.KeyValueIterator;
import org.apache.kafka.streams.state.KeyValueStore;

/** Buffers the writes to a store until {@link #apply}; its own reads see them immediately. */
final class BufferedStore implements Table<byte[]> {
    private final KeyValueStore<String, byte[]> store;
    /** Values by key; null for deletions. */
    private final Map<String, byte[]> staged = new TreeMap<>();

    BufferedStore(KeyValueStore<String, byte[]> store) {
        this.store = store;
    }

    /** @throws OversizedRecordException if a value is larger than the changelog accepts */
    void check() {
        staged.forEach((key, value) -> OversizedRecordException.check(store.name(), key, value));
    }

    void apply() {
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
    public boolean contains(String key) {
        return get(key) != null;
    }

    @Override
    public void put(String key, byte[] value) {
        staged.put(key, value);
    }

    @Override
    public void forEach(Consumer<byte[]> each) {
        try (KeyValueIterator<String, byte[]> stored = store.all()) {
            if (staged.isEmpty()) {
                stored.forEachRemaining(entry -> each.accept(entry.value));
            } else {
                Map<String, byte[]> all = new TreeMap<>();
                stored.forEachRemaining(entry -> all.put(entry.key, entry.value));
                all.putAll(staged);
                all.values().removeIf(value -> value == null);
                all.values().forEach(each);
            }
        }
    }
}
