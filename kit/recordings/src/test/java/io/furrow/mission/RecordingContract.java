package io.furrow.mission;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Random;
import java.util.function.Predicate;

import org.junit.jupiter.api.Test;

import static io.furrow.mission.RandomEvents.event;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Tests the contract of all recordings. */
public abstract class RecordingContract {
    private static final PageLimits LARGE = new PageLimits(1_000_000, Integer.MAX_VALUE);

    /** Returns a recording of these events, which are unordered. */
    public abstract Recording recorded(List<StoredEvent> events) throws Exception;

    /** Returns the bytes of an event in a page. */
    public abstract int bytes(StoredEvent event) throws Exception;

    @Test
    void readsEveryEventOnceAndInOrderForAllLimits() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int round = 0; round < 60; round++) {
            List<StoredEvent> events = RandomEvents.of(random, random.nextInt(120));
            List<StoredEvent> ordered = ordered(events);
            try (Recording recording = recorded(events)) {
                List<StoredEvent> read = new ArrayList<>();
                Cursor next = Cursor.START;
                EventPage eventPage;
                do {
                    PageLimits limits = new PageLimits(1 + random.nextInt(40), 1 + random.nextInt(8_000));
                    eventPage = recording.read(next, limits);
                    assertThat(eventPage.skipped()).as("seed %d", seed).isEmpty();
                    assertThat(eventPage.events().size()).as("seed %d", seed).isLessThanOrEqualTo(limits.events());
                    assertThat(eventPage.events().isEmpty()).as("seed %d", seed).isEqualTo(events.isEmpty());
                    boolean fits = eventPage.events().size() == 1 || total(eventPage) <= limits.bytes();
                    assertThat(fits).as("seed %d: %s", seed, limits).isTrue();
                    read.addAll(eventPage.events());
                    next = eventPage.next();
                } while (!eventPage.last());
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
                int max = 1 + random.nextInt(30);

                EventPage eventPage = recording.read(after, new PageLimits(max, Integer.MAX_VALUE));

                List<StoredEvent> rest = ordered.stream()
                        .filter(event -> Cursor.after(event).compareTo(after) > 0)
                        .toList();
                List<StoredEvent> expected = rest.subList(0, Math.min(max, rest.size()));
                assertThat(eventPage.events()).as("seed %d, %s", seed, after).isEqualTo(expected);
                assertThat(eventPage.last()).isEqualTo(expected.size() == rest.size());
                assertThat(eventPage.next())
                        .isEqualTo(expected.isEmpty() ? after : Cursor.after(expected.get(expected.size() - 1)));
            }
        }
    }

    @Test
    void stepsBackByTheRequestedNumberOfEvents() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int round = 0; round < 20; round++) {
            List<StoredEvent> events = RandomEvents.of(random, random.nextInt(120));
            List<StoredEvent> ordered = ordered(events);
            try (Recording recording = recorded(events)) {
                for (int i = 0; i < 10; i++) {
                    Cursor from = cursor(random, ordered);
                    Cursor first = random.nextInt(3) == 0 ? cursor(random, ordered) : Cursor.START;
                    int count = 1 + random.nextInt(random.nextBoolean() ? 5 : 60);
                    Predicate<StoredEvent> desired = random.nextBoolean()
                            ? event -> true
                            : event -> event.id().hashCode() % 3 == 0;
                    PageLimits limits = new PageLimits(1 + random.nextInt(40), 1 + random.nextInt(8_000));

                    Cursor back = recording.back(from, first, count, desired, limits);

                    assertThat(back)
                            .as("seed %d, round %d: %d from %s, not before %s", seed, round, count, from, first)
                            .isEqualTo(back(ordered, from, first, count, desired));
                }
            }
        }
    }

    private static Cursor cursor(Random random, List<StoredEvent> events) {
        if (events.isEmpty() || random.nextInt(8) == 0) {
            return Cursor.before(RandomEvents.TIME + random.nextInt(300));
        }
        StoredEvent any = events.get(random.nextInt(events.size()));
        return random.nextBoolean() ? Cursor.after(any) : Cursor.before(any.time());
    }

    private static Cursor back(
            List<StoredEvent> ordered, Cursor from, Cursor first, int count, Predicate<StoredEvent> desired) {
        List<StoredEvent> between = ordered.stream()
                .filter(event -> Cursor.after(event).compareTo(from) <= 0
                        && Cursor.after(event).compareTo(first) > 0)
                .toList();
        List<StoredEvent> chosen = between.stream().filter(desired).toList();
        return chosen.size() <= count ? first : Cursor.after(chosen.get(chosen.size() - count - 1));
    }

    @Test
    void stepsBackByOneEventAtLeastAndNotByMillions() throws Exception {
        try (Recording recording = recorded(List.of(event("a", 7, 0)))) {
            for (long count : new long[] {-1, 0, 100_001}) {
                assertThatThrownBy(() -> recording.back(
                                Cursor.before(9), Cursor.START, count, event -> true, PageLimits.DEFAULT))
                        .isInstanceOf(IllegalArgumentException.class)
                        .hasMessageStartingWith("A step back covers 1 to 100,000 events, not ");
            }
        }
    }

    @Test
    void stopsSteppingBackWhenItsThreadIsInterrupted() throws Exception {
        try (Recording recording = recorded(List.of(event("a", 7, 0)))) {
            Thread.currentThread().interrupt();
            assertThatThrownBy(
                            () -> recording.back(Cursor.before(9), Cursor.START, 1, event -> true, PageLimits.DEFAULT))
                    .isInstanceOf(RecordingInterruptedException.class);
            assertThat(Thread.interrupted()).isTrue();
        }
    }

    @Test
    void reportsAnInterruptAndContinuesAfterwards() throws Exception {
        try (Recording recording = recorded(List.of(event("a", 7, 0)))) {
            Thread.currentThread().interrupt();
            assertThatThrownBy(() -> recording.read(Cursor.START, LARGE))
                    .isInstanceOf(RecordingInterruptedException.class);
            assertThat(Thread.interrupted()).isTrue();
            assertThat(recording.read(Cursor.START, LARGE).events()).hasSize(1);
        }
    }

    @Test
    void endsAPageBeforeTheByteLimitAndReadsALargerEventAlone() throws Exception {
        List<StoredEvent> events =
                List.of(event("a", 1, 10), event("b", 2, 10), event("c", 3, 5_000), event("d", 4, 10));
        int small = bytes(events.get(0));
        try (Recording recording = recorded(events)) {
            PageLimits two = new PageLimits(10, 2 * small);
            EventPage first = recording.read(Cursor.START, two);
            EventPage second = recording.read(first.next(), two);
            EventPage third = recording.read(second.next(), two);

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
    void returnsItsSpan() throws Exception {
        try (Recording recording = recorded(List.of(event("a", 7, 0), event("b", -3, 0), event("c", 5, 0)))) {
            assertThat(recording.span()).contains(new RecordingExtent(-3, 7));
        }
        try (Recording recording = recorded(List.of())) {
            assertThat(recording.span()).isEmpty();
            assertThat(recording.read(Cursor.START, LARGE))
                    .isEqualTo(new EventPage(List.of(), List.of(), Cursor.START, true));
        }
    }

    private long total(EventPage eventPage) throws Exception {
        long total = 0;
        for (StoredEvent event : eventPage.events()) {
            total += bytes(event);
        }
        return total;
    }

    public static List<StoredEvent> ordered(List<StoredEvent> events) {
        List<StoredEvent> ordered = new ArrayList<>(events);
        ordered.sort(EventOrder.COMPARATOR);
        return ordered;
    }

    public static List<StoredEvent> shuffled(List<StoredEvent> events) {
        List<StoredEvent> shuffled = new ArrayList<>(events);
        Collections.shuffle(shuffled, new Random(1));
        return shuffled;
    }
}
