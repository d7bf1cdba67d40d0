package io.furrow.connect.source.http;

import java.util.Queue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.function.Supplier;

/**
 * Fails futures that are not complete by their deadlines, at most {@value #TICK_MS} ms later. One timer serves all
 * futures and runs only while futures are watched: one timer per future costs more than everything else that is done
 * for the deadline of a notification.
 */
final class TimeoutQueue {
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
     * @param deadline a value of {@link System#nanoTime}
     * @param failure called at most once, on a thread that must not be blocked; a completed future and this
     *     supplier are retained until the next tick
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
