package io.furrow.control.manager;

import java.util.function.Consumer;

/**
 * What a manager remembers, by key.
 *
 * @param <T> is never changed, only put again
 */
public interface Table<T> {
    /** Null if there is none. */
    T get(String key);

    /** Whether there is one, without reading it. */
    boolean contains(String key);

    /** @param value null removes it */
    void put(String key, T value);

    /** In the order of the keys. What is put or removed meanwhile may be seen or not. */
    void forEach(Consumer<T> each);
}
