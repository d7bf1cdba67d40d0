package io.furrow.connect.repair;

import java.io.IOException;
import java.time.Instant;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import io.furrow.connect.broker.BrokerException;

/**
 * Reads all entities from a time on, in the order of that time, page by page. The next page begins at the time of the last
 * entity seen, not behind a number of entities: an entity that changes meanwhile moves to the end and would push another one
 * over the edge of a numbered page. Only where one millisecond fills a page are entities counted, within it; they are counted
 * anew when the last entity of a page is not found again as the first of the next, and until a count finds nothing new that was begun
 * when the millisecond was over: before, one may come in where another has gone, and shift nothing.
 */
final class KeysetReader {
    /** One question to the context broker, oldest first. */
    interface Pages {
        Page page(Instant from, int offset, int limit) throws BrokerException, InterruptedException;
    }

    /**
     * @param states in order
     * @param asked how many entities it is of: at least 2, at most the limit
     * @param isFull whether there may be more
     */
    record Page(List<EntityState> states, int asked, boolean isFull) {
        boolean beginsWith(EntityState last) {
            return !states.isEmpty()
                    && states.get(0).key().equals(last.key())
                    && states.get(0).time().equals(last.time());
        }
    }

    /** Takes what was read, in order; the same state is never given twice. */
    interface Reader {
        void read(List<EntityState> states) throws BrokerException, InterruptedException, IOException;
    }

    private static final int MOST_RECOUNTS = 100;

    private final Pages pages;
    private final int limit;

    private Instant from;
    private int offset;
    /** The last of the page before, where the same millisecond goes on. */
    private EntityState expected;
    /** What was given of the millisecond {@code from}. */
    private final Set<String> given = new HashSet<>();

    private boolean isNewFound;
    /** Whether the context broker's clock was seen beyond {@code from}, and was so when this count began: nothing comes in any more. */
    private boolean isPast;

    private boolean beganPast;
    private int recounts;

    /** @param limit at least 2 */
    KeysetReader(Pages pages, int limit) {
        this.pages = pages;
        this.limit = limit;
    }

    /** Reads until a page is not full. */
    void readFrom(Instant start, Reader reader) throws BrokerException, InterruptedException, IOException {
        moveTo(start);
        while (true) {
            Page page = pages.page(from, offset, limit);
            if (isShifted(page)) {
                countAnew();
                continue;
            }
            Map<Boolean, List<EntityState>> states = page.states().stream()
                    .collect(Collectors.partitioningBy(state -> state.time().isAfter(from)));
            List<EntityState> later = states.get(true);
            read(states.get(false), reader);
            isPast |= !later.isEmpty();
            boolean atItsEnd = !page.isFull() || !later.isEmpty();
            if (!atItsEnd) {
                goOnWithin(page);
            } else if (offset > 0 && (isNewFound || isPast && !beganPast) && recounts < MOST_RECOUNTS) {
                countAnew();
            } else {
                if (!later.isEmpty()) {
                    moveThrough(later, reader);
                }
                if (!page.isFull()) {
                    return;
                }
            }
        }
    }

    /** Of the millisecond that is being read. */
    private void read(List<EntityState> states, Reader reader)
            throws BrokerException, InterruptedException, IOException {
        List<EntityState> unseen =
                states.stream().filter(state -> given.add(state.version())).toList();
        isNewFound |= !unseen.isEmpty();
        reader.read(unseen);
    }

    private void moveThrough(List<EntityState> later, Reader reader)
            throws BrokerException, InterruptedException, IOException {
        for (EntityState state : later) {
            if (state.time().isAfter(from)) {
                moveTo(state.time());
            }
            given.add(state.version());
        }
        reader.read(later);
    }

    /** The last is asked for once more, to see whether it still is where it was. */
    private void goOnWithin(Page page) {
        int count = page.states().size();
        offset += page.asked() - 1;
        expected = count == page.asked() ? page.states().get(count - 1) : null;
    }

    /** A context broker that orders one millisecond differently each time is not asked for ever. */
    private boolean isShifted(Page page) {
        return expected != null && recounts < MOST_RECOUNTS && !page.beginsWith(expected);
    }

    private void countAnew() {
        recounts++;
        offset = 0;
        expected = null;
        isNewFound = false;
        beganPast = isPast;
    }

    private void moveTo(Instant time) {
        from = time;
        isPast = false;
        countAnew();
        recounts = 0;
        given.clear();
    }
}
