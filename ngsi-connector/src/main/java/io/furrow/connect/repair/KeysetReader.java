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
 * Reads all entities from a time on, in the order of that time, page by page. The next page begins at the time of the
 * last entity seen, not at a numeric offset: an entity that changes meanwhile moves to the end and would shift another
 * one across a page boundary. Offsets are used only within a millisecond that fills a page. Counting restarts when the
 * last entity of a page is not the first of the next, and repeats until a count that began after the millisecond was
 * over finds nothing new: before, one entity may replace another without a shift.
 */
public final class KeysetReader {
    /** A request to the context broker, oldest first. */
    public interface Pages {
        Page page(Instant from, int offset, int limit) throws BrokerException, InterruptedException;
    }

    /**
     * @param states in order
     * @param asked the number of entities in it: at least 2, at most the limit
     * @param isFull whether there may be more
     */
    public record Page(List<EntityState> states, int asked, boolean isFull) {
        boolean beginsWith(EntityState last) {
            return !states.isEmpty()
                    && states.get(0).identity().equals(last.identity())
                    && states.get(0).time().equals(last.time());
        }
    }

    /** Receives the read states in order; the same state is never passed twice. */
    public interface Reader {
        void read(List<EntityState> states) throws BrokerException, InterruptedException, IOException;
    }

    private static final int MAX_RECOUNTS = 100;

    private final Pages pages;
    private final int limit;

    private Instant from;
    private int offset;
    /** The last entity of the previous page, while the same millisecond continues. */
    private EntityState expected;
    /** The states of the millisecond {@code from} that were already passed to the reader. */
    private final Set<String> given = new HashSet<>();

    private boolean isNewFound;
    /**
     * Whether the context broker's clock was beyond {@code from} when this count began: no more entities can be added.
     */
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
            } else if (offset > 0 && (isNewFound || isPast && !beganPast) && recounts < MAX_RECOUNTS) {
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

    /** Reads the states of the current millisecond. */
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

    /** Requests the last entity again, to check whether it is still in its place. */
    private void goOnWithin(Page page) {
        int count = page.states().size();
        offset += page.asked() - 1;
        expected = count == page.asked() ? page.states().get(count - 1) : null;
    }

    /** Stops for a context broker that orders one millisecond differently each time. */
    private boolean isShifted(Page page) {
        return expected != null && recounts < MAX_RECOUNTS && !page.beginsWith(expected);
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
