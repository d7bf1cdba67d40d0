package io.furrow.connect.source.http;

import java.util.ArrayList;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;

/** A number of bytes that several exchanges share. A caller waits until enough bytes are available and is called in order of arrival. */
public final class ByteBudget {
    private final Map<Runnable, Long> waiting = new LinkedHashMap<>();
    private final Executor callers;
    private final long size;
    private long left;

    /** @param callers runs the callbacks of waiting callers */
    public ByteBudget(long bytes, Executor callers) {
        this.size = bytes;
        this.left = bytes;
        this.callers = callers;
    }

    /** The total size, whether reserved or available. */
    long size() {
        return size;
    }

    /**
     * Completed when the bytes are reserved, possibly immediately; failed with {@link OverloadException} if they are
     * not available in time.
     */
    CompletableFuture<Void> take(long bytes, long nanos) {
        CompletableFuture<Void> taken = new CompletableFuture<>();
        Runnable whenTaken = () -> taken.complete(null);
        if (take(bytes, whenTaken)) {
            taken.complete(null);
            return taken;
        }
        taken.copy().orTimeout(nanos, TimeUnit.NANOSECONDS).whenComplete((nothing, late) -> {
            if (giveUp(whenTaken)) {
                taken.completeExceptionally(OverloadException.noRoom());
            }
        });
        return taken;
    }

    /** Whether the bytes were reserved immediately: they are available and no caller waits. */
    private synchronized boolean take(long bytes, Runnable whenTaken) {
        if (waiting.isEmpty() && left >= bytes) {
            left -= bytes;
            return true;
        }
        waiting.put(whenTaken, bytes);
        return false;
    }

    /** Whether the callback was still waiting; it will no longer be called. */
    private synchronized boolean giveUp(Runnable whenTaken) {
        return waiting.remove(whenTaken) != null;
    }

    void giveBack(long bytes) {
        if (bytes > 0) {
            served(bytes).forEach(callers::execute);
        }
    }

    private synchronized List<Runnable> served(long bytes) {
        left += bytes;
        if (waiting.isEmpty()) {
            return List.of();
        }
        List<Runnable> served = new ArrayList<>();
        Iterator<Map.Entry<Runnable, Long>> next = waiting.entrySet().iterator();
        while (next.hasNext()) {
            Map.Entry<Runnable, Long> first = next.next();
            if (left < first.getValue()) {
                break;
            }
            left -= first.getValue();
            served.add(first.getKey());
            next.remove();
        }
        return served;
    }
}
