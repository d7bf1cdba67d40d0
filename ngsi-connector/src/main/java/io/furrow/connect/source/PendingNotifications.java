package io.furrow.connect.source;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;

/**
 * Keeps notifications in memory, in the order in which they came, until each of their records was acknowledged; at most
 * {@code maxCount} notifications and {@code maxBytes} bytes of records.
 */
final class PendingNotifications implements Intake {
    /** A record and the notification that it belongs to. */
    record Pending(long notification, OutgoingRecord record) {}

    private static final class Open {
        private final CompletableFuture<Void> durable = new CompletableFuture<>();
        private final long bytes;
        private int missing;

        Open(int records, long bytes) {
            this.missing = records;
            this.bytes = bytes;
        }
    }

    private final int maxCount;
    private final long maxBytes;
    private final BlockingQueue<Pending> queue = new LinkedBlockingQueue<>();
    private final Map<Long, Open> open = new HashMap<>();
    private long bytes;
    private long last;
    private boolean closed;

    PendingNotifications(int maxCount, long maxBytes) {
        this.maxCount = maxCount;
        this.maxBytes = maxBytes;
    }

    @Override
    public synchronized Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records) {
        if (closed) {
            return Optional.of(CompletableFuture.failedFuture(new ClosedException()));
        }
        if (records.isEmpty()) {
            return Optional.of(CompletableFuture.completedFuture(null));
        }
        long size = records.stream().mapToLong(OutgoingRecord::bytes).sum();
        // A single notification may exceed the bytes when nothing else waits: otherwise it could never pass.
        if (open.size() >= maxCount || (bytes + size > maxBytes && !open.isEmpty())) {
            return Optional.empty();
        }
        Open notification = new Open(records.size(), size);
        long number = ++last;
        open.put(number, notification);
        bytes += size;
        records.forEach(record -> queue.add(new Pending(number, record)));
        return Optional.of(notification.durable);
    }

    /** The next records, at most {@code max}; waits up to {@code wait} for the first and not at all for more. */
    List<Pending> next(int max, Duration wait) throws InterruptedException {
        Pending first = queue.poll(wait.toMillis(), TimeUnit.MILLISECONDS);
        if (first == null) {
            return List.of();
        }
        List<Pending> next = new ArrayList<>();
        next.add(first);
        queue.drainTo(next, max - 1);
        return next;
    }

    /** One record of a notification is durable. */
    void acknowledge(long notification) {
        CompletableFuture<Void> complete = acknowledged(notification);
        if (complete != null) {
            complete.complete(null);
        }
    }

    private synchronized CompletableFuture<Void> acknowledged(long notification) {
        Open found = open.get(notification);
        if (found == null || --found.missing > 0) {
            return null;
        }
        open.remove(notification);
        bytes -= found.bytes;
        return found.durable;
    }

    /** Records without an acknowledgement. */
    synchronized long records() {
        return open.values().stream()
                .mapToLong(notification -> notification.missing)
                .sum();
    }

    synchronized int count() {
        return open.size();
    }

    synchronized long bytes() {
        return bytes;
    }

    /** Fails what is open and takes nothing more. */
    void close() {
        List<Open> left;
        synchronized (this) {
            closed = true;
            left = List.copyOf(open.values());
            open.clear();
            queue.clear();
            bytes = 0;
        }
        left.forEach(notification -> notification.durable.completeExceptionally(new ClosedException()));
    }
}
