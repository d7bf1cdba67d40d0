package io.furrow.control.manager;

import java.util.function.Consumer;
import java.util.function.Function;

import org.apache.kafka.common.serialization.Serdes;
import org.apache.kafka.streams.processor.api.ProcessorContext;
import org.apache.kafka.streams.state.KeyValueIterator;
import org.apache.kafka.streams.state.KeyValueStore;
import org.apache.kafka.streams.state.StoreBuilder;
import org.apache.kafka.streams.state.Stores;

/**
 * Remembers in a named store. What managers remember is small: the stores are in memory and rebuilt from their changelogs, so
 * that there is no local state which could be lost or out of step.
 */
public final class StoreTable<T> implements Table<T> {
    private final KeyValueStore<String, byte[]> store;
    private final Function<T, byte[]> writer;
    private final Function<byte[], T> reader;

    private StoreTable(KeyValueStore<String, byte[]> store, Function<T, byte[]> writer, Function<byte[], T> reader) {
        this.store = store;
        this.writer = writer;
        this.reader = reader;
    }

    public static StoreBuilder<KeyValueStore<String, byte[]>> builder(String name) {
        return Stores.keyValueStoreBuilder(Stores.inMemoryKeyValueStore(name), Serdes.String(), Serdes.ByteArray());
    }

    /** What is in a store as JSON of a type. */
    public static <T> Table<T> of(ProcessorContext<?, ?> context, String name, Class<T> type) {
        return of(context, name, StateJson::write, json -> StateJson.read(json, type));
    }

    /** What is in a store in a form of its own. */
    public static <T> Table<T> of(
            ProcessorContext<?, ?> context, String name, Function<T, byte[]> writer, Function<byte[], T> reader) {
        return new StoreTable<>(context.getStateStore(name), writer, reader);
    }

    @Override
    public T get(String key) {
        byte[] value = store.get(key);
        return value == null ? null : reader.apply(value);
    }

    @Override
    public boolean contains(String key) {
        return store.get(key) != null;
    }

    @Override
    public void put(String key, T value) {
        store.put(key, value == null ? null : writer.apply(value));
    }

    @Override
    public void forEach(Consumer<T> each) {
        try (KeyValueIterator<String, byte[]> all = store.all()) {
            while (all.hasNext()) {
                each.accept(reader.apply(all.next().value));
            }
        }
    }
}
