package io.furrow.flink.format;

import java.lang.ref.WeakReference;
import java.util.function.Supplier;

/**
 * One object for all tasks of a job in a process: each task has a thread of its own, which holds it from its first use to its
 * end. When the last of them has ended nobody does, and it goes.
 *
 * @param <T> what can be used by several threads
 */
public final class SharedByTasks<T> {
    private final Supplier<T> made;
    private final ThreadLocal<T> ofThread = ThreadLocal.withInitial(this::ofAll);
    private WeakReference<T> ofAll = new WeakReference<>(null);

    public SharedByTasks(Supplier<T> made) {
        this.made = made;
    }

    /** That of the tasks that run; a new one if there is none. */
    public T get() {
        return ofThread.get();
    }

    private synchronized T ofAll() {
        T shared = ofAll.get();
        if (shared == null) {
            shared = made.get();
            ofAll = new WeakReference<>(shared);
        }
        return shared;
    }
}
