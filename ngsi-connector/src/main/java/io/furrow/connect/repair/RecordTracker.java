package io.furrow.connect.repair;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.function.Consumer;
import java.util.function.Function;
import java.util.function.Supplier;

import io.furrow.connect.repair.LastRecordCache.Comparison;

/**
 * Orders the records of notifications and repairs, and tracks the state that the repair needs: the number of arrived
 * notifications per subscription and the last record of each entity. Thread-safe; the lock is held while serialized
 * records are appended, never during serialization.
 */
public final class RecordTracker {
    private final NotificationCounter notificationCounter = new NotificationCounter();
    private final LastRecordCache last;
    private volatile Consumer<String> staleListener = identity -> {};
    private volatile Consumer<Instant> overflowListener = from -> {};

    /** @param maxBytes heap for the tracked entities */
    public RecordTracker(long maxBytes) {
        last = new LastRecordCache(maxBytes);
    }

    /** Appends records; empty if there is no room now. */
    public interface Appending extends Supplier<Optional<CompletableFuture<Void>>> {}

    /** A notification of a subscription arrived, whatever its result. */
    public synchronized void arrived(String subscription) {
        notificationCounter.add(subscription, 1);
    }

    synchronized long arrivedOf(String subscription) {
        return notificationCounter.of(subscription);
    }

    synchronized void follow(String former, String subscription) {
        notificationCounter.replace(former, subscription);
    }

    /**
     * Appends the records of one notification.
     *
     * @param subscription that sent it
     * @param records of entities; the others need no order
     */
    public Optional<CompletableFuture<Void>> append(
            String subscription, List<TrackedRecord> records, Appending appending) {
        Optional<CompletableFuture<Void>> durable;
        List<TrackedRecord> stale = new ArrayList<>(0);
        synchronized (this) {
            durable = appending.get();
            if (durable.isEmpty()) {
                return durable;
            }
            boolean isNew = records.isEmpty();
            for (TrackedRecord record : records) {
                isNew |= last.append(record, subscription);
                if (last.isStale(record.identity())) {
                    stale.add(record);
                }
            }
            if (!isNew) {
                // A duplicate, or already repaired: it would hide a notification that did not arrive.
                notificationCounter.add(subscription, -1);
            }
        }
        return Optional.of(watched(durable.get(), records, stale));
    }

    private CompletableFuture<Void> watched(
            CompletableFuture<Void> durable, List<TrackedRecord> records, List<TrackedRecord> stale) {
        Consumer<String> listener = staleListener;
        return durable.whenComplete((nothing, failure) -> {
            if (failure != null) {
                synchronized (this) {
                    records.forEach(last::fail);
                }
            }
            (failure == null ? stale : records).forEach(record -> listener.accept(record.identity()));
            reportOverflow();
        });
    }

    private void reportOverflow() {
        Optional<Instant> from;
        synchronized (this) {
            from = last.takeOverflow();
        }
        from.ifPresent(overflowListener);
    }

    /** Registers a listener for each entity that has to be read again; it is called from any thread. */
    void onStale(Consumer<String> listener) {
        staleListener = listener;
    }

    /**
     * Registers a listener for the time from which changes have to be read again because more entities were stale than
     * are tracked; it is called from any thread.
     */
    void onOverflow(Consumer<Instant> listener) {
        overflowListener = listener;
    }

    /** Restores the entities that were to be read again when the source stopped. */
    synchronized void restoreStale(Iterable<String> identities) {
        identities.forEach(last::restoreStale);
    }

    /** A record that was in the journal at the start left it. */
    public synchronized void restore(TrackedRecord record) {
        last.restore(record);
    }

    /** Whether a read state is new. */
    boolean isNews(TrackedRecord found, long asked) {
        Comparison comparison;
        synchronized (this) {
            comparison = last.judge(found, asked);
        }
        reportOverflow();
        return comparison == Comparison.NEWS;
    }

    /** The findings of a repair that were appended; empty durability if there was no room. */
    record Appended<T>(List<T> found, Optional<CompletableFuture<Void>> durable) {}

    /**
     * Appends the new states among those read from the context broker.
     *
     * @param asked the {@link #now} before the context broker was queried
     */
    <T> Appended<T> appendNews(
            List<T> found,
            Function<T, TrackedRecord> record,
            long asked,
            Function<List<T>, Optional<CompletableFuture<Void>>> appending) {
        try {
            return appendedNews(found, record, asked, appending);
        } finally {
            reportOverflow();
        }
    }

    private <T> Appended<T> appendedNews(
            List<T> found,
            Function<T, TrackedRecord> record,
            long asked,
            Function<List<T>, Optional<CompletableFuture<Void>>> appending) {
        Appended<T> appended;
        synchronized (this) {
            List<T> news = new ArrayList<>();
            for (T each : found) {
                if (last.judge(record.apply(each), asked) == Comparison.NEWS) {
                    news.add(each);
                }
            }
            if (news.isEmpty()) {
                return new Appended<>(news, Optional.of(CompletableFuture.completedFuture(null)));
            }
            appended = new Appended<>(news, appending.apply(news));
            if (appended.durable().isEmpty()) {
                return appended;
            }
            news.forEach(each -> last.appendFound(record.apply(each)));
        }
        List<TrackedRecord> records = appended.found().stream().map(record).toList();
        return new Appended<>(
                appended.found(), Optional.of(watched(appended.durable().get(), records, List.of())));
    }

    /** A position in the order of records. */
    synchronized long now() {
        return last.now();
    }

    /** Entities whose last record may not be the newest. */
    synchronized List<String> stale() {
        return last.stale();
    }

    synchronized void settle(String identity) {
        last.settle(identity);
    }

    /** Changes before this time may be on the topic although they are not tracked. */
    synchronized void forgetUntil(Instant time) {
        last.forgetUntil(time);
    }
}
