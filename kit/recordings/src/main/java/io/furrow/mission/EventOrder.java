package io.furrow.mission;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.Iterator;
import java.util.List;
import java.util.NoSuchElementException;
import java.util.PriorityQueue;

/** Events in the order of archives: by event time, those of one millisecond by event id. */
public final class EventOrder {
    public static final Comparator<StoredEvent> COMPARATOR =
            Comparator.comparingLong(StoredEvent::time).thenComparing(StoredEvent::id);

    private EventOrder() {}

    /** Brings what is in order of time into the whole order; holds the events of one millisecond. */
    public static Iterator<StoredEvent> within(Iterator<StoredEvent> byTime) {
        return new Iterator<>() {
            private final List<StoredEvent> sameTime = new ArrayList<>();
            private int next;
            private StoredEvent ahead = byTime.hasNext() ? byTime.next() : null;

            @Override
            public boolean hasNext() {
                return next < sameTime.size() || ahead != null;
            }

            @Override
            public StoredEvent next() {
                if (next == sameTime.size()) {
                    gather();
                }
                return sameTime.get(next++);
            }

            private void gather() {
                if (ahead == null) {
                    throw new NoSuchElementException();
                }
                sameTime.clear();
                next = 0;
                long time = ahead.time();
                while (ahead != null && ahead.time() == time) {
                    sameTime.add(ahead);
                    ahead = byTime.hasNext() ? byTime.next() : null;
                }
                sameTime.sort(COMPARATOR);
            }
        };
    }

    /** One ordered stream out of several. */
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
