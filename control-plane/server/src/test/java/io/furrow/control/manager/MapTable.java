package io.furrow.control.manager;

import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Consumer;
import java.util.function.Function;

import io.furrow.model.ngsi.StateJson;

/** A table in memory that serializes its values like stores do, so that values that are not restorable fail here too. */
public final class MapTable<T> implements Table<T> {
    private final Map<String, byte[]> bytes = new TreeMap<>();
    private final Function<T, byte[]> writer;
    private final Function<byte[], T> reader;

    public MapTable(Function<T, byte[]> writer, Function<byte[], T> reader) {
        this.writer = writer;
        this.reader = reader;
    }

    public static <T> MapTable<T> of(Class<T> type) {
        return new MapTable<>(StateJson::write, json -> StateJson.read(json, type));
    }

    @Override
    public T get(String key) {
        return bytes.containsKey(key) ? reader.apply(bytes.get(key)) : null;
    }

    @Override
    public boolean contains(String key) {
        return bytes.containsKey(key);
    }

    @Override
    public void put(String key, T value) {
        if (value == null) {
            bytes.remove(key);
        } else {
            bytes.put(key, writer.apply(value));
        }
    }

    @Override
    public void forEach(Consumer<T> each) {
        all().forEach(each);
    }

    public List<T> all() {
        return bytes.values().stream().map(reader).toList();
    }

    /** Returns the serialized content, for comparisons. */
    public String content() {
        StringBuilder content = new StringBuilder();
        bytes.forEach((key, value) ->
                content.append(key).append('=').append(new String(value)).append('\n'));
        return content.toString();
    }
}
