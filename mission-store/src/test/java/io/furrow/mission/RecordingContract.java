package io.furrow.mission;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** What every kind of recording promises. */
abstract class RecordingContract {
    private static final PageLimits LARGE = new PageLimits(1_000_000, Integer.MAX_VALUE);

    /** A recording of these events, which come in any order. */
    abstract Recording recorded(List<StoredEvent> events) throws Exception;

    /** How many bytes of a page an event takes. */
    abstract int bytes(StoredEvent event) throws Exception;

    @Test
    void givesEveryEventOnceAndInOrderWhateverTheLimits() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int round = 0; round < 60; round++) {
            List<StoredEvent> events = RandomEvents.of(random, random.nextInt(120));
            List<StoredEvent> ordered = ordered(events);
            try (Recording recording = recorded(events)) {
                List<StoredEvent> read = new ArrayList<>();
                Cursor next = Cursor.START;
                Page page;
                do {
                    PageLimits limits = new PageLimits(1 + random.nextInt(40), 1 + random.nextInt(8_000));
                    page = recording.read(next, limits);
                    assertThat(page.skipped()).as("seed %d", seed).isEmpty();
                    assertThat(page.events().size()).as("seed %d", seed).isLessThanOrEqualTo(limits.events());
                    assertThat(page.events().isEmpty()).as("seed %d", seed).isEqualTo(events.isEmpty());
                    boolean fits = page.events().size() == 1 || total(page) <= limits.bytes();
                    assertThat(fits).as("seed %d: %s", seed, limits).isTrue();
                    read.addAll(page.events());
                    next = page.next();
                } while (!page.last());
                assertThat(read).as("seed %d, round %d", seed, round).isEqualTo(ordered);
            }
        }
    }

    @Test
    void beginsAtAnyCursor() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        List<StoredEvent> events = RandomEvents.of(random, 100);
        List<StoredEvent> ordered = ordered(events);
        try (Recording recording = recorded(events)) {
            for (int round = 0; round < 60; round++) {
                StoredEvent any = ordered.get(random.nextInt(ordered.size()));
                Cursor after = random.nextBoolean() ? Cursor.after(any) : Cursor.before(any.time());
                int most = 1 + random.nextInt(30);

                Page page = recording.read(after, new PageLimits(most, Integer.MAX_VALUE));

                List<StoredEvent> rest = ordered.stream()
                        .filter(event -> Cursor.after(event).compareTo(after) > 0)
                        .toList();
                List<StoredEvent> expected = rest.subList(0, Math.min(most, rest.size()));
                assertThat(page.events()).as("seed %d, %s", seed, after).isEqualTo(expected);
                assertThat(page.last()).isEqualTo(expected.size() == rest.size());
                assertThat(page.next())
                        .isEqualTo(expected.isEmpty() ? after : Cursor.after(expected.get(expected.size() - 1)));
            }
        }
    }

    @Test
    void stopsBeforeTheEventThatPassesTheByteLimitAndGivesOneThatIsLargerAlone() throws Exception {
        List<StoredEvent> events = List.of(
                RandomEvents.event("a", 1, 10),
                RandomEvents.event("b", 2, 10),
                RandomEvents.event("c", 3, 5_000),
                RandomEvents.event("d", 4, 10));
        int small = bytes(events.get(0));
        try (Recording recording = recorded(events)) {
            PageLimits two = new PageLimits(10, 2 * small);
            Page first = recording.read(Cursor.START, two);
            Page second = recording.read(first.next(), two);
            Page third = recording.read(second.next(), two);

            assertThat(first.events()).extracting(StoredEvent::id).containsExactly("a", "b");
            assertThat(second.events()).extracting(StoredEvent::id).containsExactly("c");
            assertThat(third.events()).extracting(StoredEvent::id).containsExactly("d");
            assertThat(List.of(first.last(), second.last(), third.last())).containsExactly(false, false, true);
            assertThat(recording
                            .read(Cursor.START, new PageLimits(10, 2 * small - 1))
                            .events())
                    .hasSize(1);
        }
    }

    @Test
    void tellsItsSpan() throws Exception {
        try (Recording recording = recorded(List.of(
                RandomEvents.event("a", 7, 0), RandomEvents.event("b", -3, 0), RandomEvents.event("c", 5, 0)))) {
            assertThat(recording.span()).contains(new Span(-3, 7, 3));
        }
        try (Recording recording = recorded(List.of())) {
            assertThat(recording.span()).isEmpty();
            assertThat(recording.read(Cursor.START, LARGE))
                    .isEqualTo(new Page(List.of(), List.of(), Cursor.START, true));
        }
    }

    private long total(Page page) throws Exception {
        long total = 0;
        for (StoredEvent event : page.events()) {
            total += bytes(event);
        }
        return total;
    }

    static List<StoredEvent> ordered(List<StoredEvent> events) {
        List<StoredEvent> ordered = new ArrayList<>(events);
        ordered.sort(EventOrder.COMPARATOR);
        return ordered;
    }

    static List<StoredEvent> shuffled(List<StoredEvent> events) {
        List<StoredEvent> shuffled = new ArrayList<>(events);
        Collections.shuffle(shuffled, new Random(1));
        return shuffled;
    }
}
