package io.furrow.control.manager;

import java.util.function.Consumer;
import java.util.function.Function;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.state.KeyValueStore;
import org.apache.kafka.streams.state.StoreBuilder;
import org.apache.kafka.streams.state.Stores;

/**
 * Accesses a named store as a table of typed values. The state of managers is small: stores are held in memory and
 * restored from their changelogs, so that no local state can be lost or inconsistent.
 */
public record StoreTable<T>(Table<byte[]> store, Function<T, byte[]> writer, Function<byte[], T> reader)
        implements Table<T> {
    static StoreBuilder<KeyValueStore<String, byte[]>> builder(String name) {
        return Stores.keyValueStoreBuilder(Stores.inMemoryKeyValueStore(name), Serdes.String(), Serdes.ByteArray());
    }

    /** Returns the values of a store, for a processor that only reads it. */
    public static Table<byte[]> readOnly(ProcessorContext<?, ?> context, String name) {
        return new BufferedStore(context.getStateStore(name));
    }

    @Override
    public T get(String key) {
        byte[] value = store.get(key);
        return value == null ? null : reader.apply(value);
    }

    @Override
    public boolean contains(String key) {
        return store.contains(key);
    }

    @Override
    public void put(String key, T value) {
        store.put(key, value == null ? null : writer.apply(value));
    }

    @Override
    public void forEach(Consumer<T> each) {
        store.forEach(value -> each.accept(reader.apply(value)));
    }
}
