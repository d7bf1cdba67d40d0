package io.furrow.connect.source;

import java.util.Queue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Supplier;

/**
 * Fails futures that are not complete by their deadlines, at most {@value #TICK_MS} ms later. One timer serves all, and none runs
 * while there is nothing to watch: a timer for each future costs more than all else that is done for a notification's deadline.
 */
final class Deadlines {
    static final long TICK_MS = 50;

    private static final Executor TICKS =
            CompletableFuture.delayedExecutor(TICK_MS, TimeUnit.MILLISECONDS, Runnable::run);

    private record Watched(CompletableFuture<?> future, long deadline, Supplier<Throwable> failure) {
        boolean isOver(long now) {
            if (!future.isDone() && now - deadline >= 0) {
                future.completeExceptionally(failure.get());
            }
            return future.isDone();
        }
    }

    private final Queue<Watched> watched = new ConcurrentLinkedQueue<>();
    private final AtomicBoolean ticking = new AtomicBoolean();

    /**
     * @param deadline one of {@link System#nanoTime}
     * @param failure called at most once, on a thread that must not be held up; a future that is complete stays here until the next
     *     tick, and this with it
     */
    void watch(CompletableFuture<?> future, long deadline, Supplier<Throwable> failure) {
        watched.add(new Watched(future, deadline, failure));
        tickLater();
    }

    private void tickLater() {
        if (!ticking.get() && ticking.compareAndSet(false, true)) {
            TICKS.execute(this::tick);
        }
    }

    private void tick() {
        long now = System.nanoTime();
        try {
            watched.removeIf(each -> each.isOver(now));
        } finally {
            ticking.set(false);
            if (!watched.isEmpty()) {
                tickLater();
            }
        }
    }
}
