package io.furrow.replay.recording;

import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.Cursor;
import io.furrow.mission.PageLimits;
import io.furrow.replay.playback.ReadyEvent;
import io.furrow.replay.playback.ReadyPage;

import static org.assertj.core.api.Assertions.assertThat;

class PageBudgetTest {
    private static final int REPLAYS = 256;
    private static final PageLimits MAX = new PageLimits(1_000, 4 * 1024 * 1024);
    private static final long BOUND = PageBudget.BYTES + 2 * REPLAYS * PageBudget.MIN_PAGE_BYTES;

    private final PageBudget budget = new PageBudget(MAX);

    @Test
    void grantsTheRequestOfASingleReplay() {
        PageBudget.Pages pages = budget.pages();

        assertThat(pages.next(5_000)).isEqualTo(MAX);
        assertThat(pages.next(32).events()).isEqualTo(32);
    }

    @Test
    void staysWithinItsBoundForManyReplays() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        List<PageBudget.Pages> replays =
                IntStream.range(0, REPLAYS).mapToObj(i -> budget.pages()).toList();
        for (int turn = 0; turn < 20 * REPLAYS; turn++) {
            PageBudget.Pages pages = replays.get(turn < REPLAYS ? turn : random.nextInt(REPLAYS));
            PageLimits limits = pages.next(Integer.MAX_VALUE);
            assertThat(budget.used()).as("seed %d, turn %d", seed, turn).isLessThanOrEqualTo(BOUND);
            pages.add(full(limits));
            pages.settle();
            assertThat(budget.used()).as("seed %d, turn %d", seed, turn).isLessThanOrEqualTo(BOUND);
        }
        assertThat(budget.used()).as("seed %d", seed).isGreaterThan(PageBudget.BYTES / 2);

        replays.forEach(PageBudget.Pages::clear);
        assertThat(budget.used()).isZero();
    }

    @Test
    void countsOnlyTheTwoNewestPages() {
        PageBudget.Pages pages = budget.pages();
        pages.next(10);
        pages.settle();
        assertThat(budget.used()).isZero();

        for (int events : List.of(10, 20, 30)) {
            pages.add(page(events, 1024));
            pages.settle();
        }
        assertThat(budget.used()).isEqualTo(50 * 2048);
    }

    private static ReadyPage full(PageLimits limits) {
        return page(limits.events(), limits.bytes() / limits.events());
    }

    private static ReadyPage page(int count, int bytes) {
        TopicRecord record = TopicRecord.of("data.m.replay.0a1b2c3d", 1, "urn:d", new byte[bytes], Map.of());
        List<ReadyEvent> events = Collections.nCopies(count, new ReadyEvent(new Cursor(1, "e"), record));
        return new ReadyPage(events, count, 1, 0, new Cursor(1, "e"), false);
    }
}
