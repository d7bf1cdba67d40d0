package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.function.Predicate;

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

    /** A copy, so that those may be put or removed meanwhile. */
    default List<T> where(Predicate<T> some) {
        List<T> found = new ArrayList<>();
        forEach(each -> {
            if (some.test(each)) {
                found.add(each);
            }
        });
        return found;
    }

    /** As {@link #where}. */
    default List<T> all() {
        return where(each -> true);
    }
}
