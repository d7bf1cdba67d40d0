package io.furrow.control.manager;

import java.util.ArrayList;
import java.util.List;
import java.util.function.Consumer;
import java.util.function.Predicate;

/**
 * A key-value store of a manager.
 *
 * @param <T> type of values, which are immutable
 */
public interface Table<T> {
    /** Returns the value; null if there is none. */
    T get(String key);

    /** Whether there is a value, without deserializing it. */
    boolean contains(String key);

    /** @param value null removes it */
    void put(String key, T value);

    /** Visits the values in the order of their keys. Concurrent changes may or may not be visible. */
    void forEach(Consumer<T> each);

    /** Returns a copy of the matching values, so that the table may be changed during the iteration. */
    default List<T> where(Predicate<T> some) {
        List<T> found = new ArrayList<>();
        forEach(each -> {
            if (some.test(each)) {
                found.add(each);
            }
        });
        return found;
    }

    /** Returns a copy of all values, as {@link #where}. */
    default List<T> all() {
        return where(each -> true);
    }
}
