package io.furrow.bench.replay;

import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import io.furrow.bench.frame.ProcessStatus;

/** Triggers garbage collection every few seconds and reports the growth of the heap in use. */
final class HeapGrowth implements AutoCloseable {
    private static final long SECONDS = 5;
    private static final long MEBI = 1024 * 1024;

    private final CountDownLatch closed = new CountDownLatch(1);
    private final Thread thread;
    private final long before;
    private volatile long most;

    private HeapGrowth(Consumer<String> progress) {
        before = used();
        progress.accept("heap before: %,d MiB".formatted(before));
        thread = new Thread(() -> sample(progress), "bench-heap");
    }

    static HeapGrowth start(Consumer<String> progress) {
        HeapGrowth heap = new HeapGrowth(progress);
        heap.thread.start();
        return heap;
    }

    private void sample(Consumer<String> progress) {
        try {
            while (!closed.await(SECONDS, TimeUnit.SECONDS)) {
                long held = used() - before;
                most = Math.max(most, held);
                progress.accept("heap after a collection: %+,d MiB".formatted(held));
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private static long used() {
        return ProcessStatus.heapAfterCollection() / MEBI;
    }

    /** The greatest growth, MiB. */
    long most() {
        return most;
    }

    @Override
    public void close() {
        closed.countDown();
        try {
            thread.join();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
