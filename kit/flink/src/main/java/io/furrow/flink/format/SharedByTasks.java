package io.furrow.flink.format;

import java.lang.ref.WeakReference;
import java.util.function.Supplier;

/**
 * Shares one object among all tasks of a job in a process: each task, on its own thread, holds it from its first use to its
 * end. It is released when the last task has ended.
 *
 * @param <T> a thread-safe type
 */
public final class SharedByTasks<T> {
    private final Supplier<T> made;
    private final ThreadLocal<T> ofThread = ThreadLocal.withInitial(this::ofAll);
    private WeakReference<T> ofAll = new WeakReference<>(null);

    public SharedByTasks(Supplier<T> made) {
        this.made = made;
    }

    /** The object of the running tasks; a new one if there is none. */
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
