package io.furrow.connect.repair;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;
import java.util.concurrent.locks.ReadWriteLock;
import java.util.concurrent.locks.ReentrantReadWriteLock;
import java.util.function.Supplier;

/**
 * What comes by notification, as far as the repair must know it: how many of each subscription, which events became durable, and
 * which entities changed while it reads. Any thread.
 */
public final class LiveEvents {
    private static final int MOST_SUBSCRIPTIONS = 10_000;
    private static final int MOST_EVENTS = 200_000;

    private final Map<String, LongAdder> arrived = new ConcurrentHashMap<>();
    private final SeenEvents seen = new SeenEvents(MOST_EVENTS);
    private final ReadWriteLock order = new ReentrantReadWriteLock();
    /** When an entity last came, by {@link System#nanoTime}; only kept during a repair. */
    private final Map<String, Long> came = new ConcurrentHashMap<>();

    private volatile boolean watching;

    /** A notification of a subscription came, whatever became of it. */
    public void arrived(String subscription) {
        // Anybody can send any id: the first ten thousand are counted.
        LongAdder count = arrived.get(subscription);
        if (count == null && arrived.size() < MOST_SUBSCRIPTIONS) {
            count = arrived.computeIfAbsent(subscription, id -> new LongAdder());
        }
        if (count != null) {
            count.increment();
        }
    }

    long arrivedOf(String subscription) {
        LongAdder count = arrived.get(subscription);
        return count == null ? 0 : count.sum();
    }

    /**
     * Hands events of notifications on; not while a repair does, so that of an entity what is newer is always the later record.
     *
     * @param identities of their entities
     */
    public <T> T handOn(Iterable<String> identities, Supplier<T> taking) {
        order.readLock().lock();
        try {
            if (watching) {
                long now = System.nanoTime();
                identities.forEach(identity -> came.put(identity, now));
            }
            return taking.get();
        } finally {
            order.readLock().unlock();
        }
    }

    /** An event, by its id, is durable. */
    public void durable(String eventId) {
        seen.add(eventId);
    }

    boolean isSeen(String eventId) {
        return seen.contains(eventId);
    }

    /** Hands findings of a repair on; no event of a notification is handed on meanwhile. */
    <T> T handOnAlone(Supplier<T> taking) {
        order.writeLock().lock();
        try {
            return taking.get();
        } finally {
            order.writeLock().unlock();
        }
    }

    /** Begins to keep which entities come. */
    void watch() {
        watching = true;
    }

    void watchNoMore() {
        watching = false;
        came.clear();
    }

    /** Whether an entity came by notification since then. */
    boolean cameSince(String identity, long nanoTime) {
        Long last = came.get(identity);
        return last != null && last - nanoTime >= 0;
    }
}
