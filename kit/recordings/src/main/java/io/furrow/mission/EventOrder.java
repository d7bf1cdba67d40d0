package io.furrow.mission;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.Iterator;
import java.util.List;
import java.util.NoSuchElementException;
import java.util.PriorityQueue;

/** Orders events by event time, then by event id, as archives do. */
public final class EventOrder {
    public static final Comparator<StoredEvent> COMPARATOR =
            Comparator.comparingLong(StoredEvent::time).thenComparing(StoredEvent::id);

    private EventOrder() {}

    /** Sorts the events of each millisecond in a sequence that is ordered by time; holds one millisecond in memory. */
    public static Iterator<StoredEvent> within(Iterator<StoredEvent> byTime) {
        return new Iterator<>() {
            private final List<StoredEvent> sameTime = new ArrayList<>();
            private int next;
            private StoredEvent following = byTime.hasNext() ? byTime.next() : null;

            @Override
            public boolean hasNext() {
                return next < sameTime.size() || following != null;
            }

            @Override
            public StoredEvent next() {
                if (next == sameTime.size()) {
                    readSameTime();
                }
                return sameTime.get(next++);
            }

            private void readSameTime() {
                if (following == null) {
                    throw new NoSuchElementException();
                }
                sameTime.clear();
                next = 0;
                long time = following.time();
                while (following != null && following.time() == time) {
                    sameTime.add(following);
                    following = byTime.hasNext() ? byTime.next() : null;
                }
                sameTime.sort(COMPARATOR);
            }
        };
    }

    /** Merges ordered sequences into one. */
    public static Iterator<StoredEvent> merged(List<Iterator<StoredEvent>> ordered) {
        record Head(StoredEvent event, Iterator<StoredEvent> rest) {}
        PriorityQueue<Head> heads = new PriorityQueue<>(Comparator.comparing(Head::event, COMPARATOR));
        ordered.stream().filter(Iterator::hasNext).forEach(rest -> heads.add(new Head(rest.next(), rest)));
        return new Iterator<>() {
            @Override
            public boolean hasNext() {
                return !heads.isEmpty();
            }

            @Override
            public StoredEvent next() {
                Head head = heads.remove();
                if (head.rest().hasNext()) {
                    heads.add(new Head(head.rest().next(), head.rest()));
                }
                return head.event();
            }
        };
    }
}
