package io.furrow.connect.repair;

import java.time.Duration;
import java.util.Set;
import java.util.TreeSet;
import java.util.concurrent.atomic.AtomicLong;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class ListingScheduleTest {
    private final AtomicLong nanos = new AtomicLong();
    private final ListingSchedule listings = new ListingSchedule(ModelSource.PLACE, Duration.ofMinutes(10), nanos::get);

    @Test
    void countsOnlyEntitiesAsDeletedThatTwoListingsLack() {
        listings.demand(true);
        assertThat(listings.deleted(of("abcdef"), 8)).isEmpty();
        listings.done();

        listings.demand(true);
        pass(Duration.ofSeconds(59));
        assertThat(listings.isNow()).isFalse();
        pass(Duration.ofSeconds(1));
        assertThat(listings.isNow()).isTrue();
        assertThat(listings.deleted(of("bcdefgh"), 8)).isEqualTo(of("bcdef"));
        listings.done();
        assertThat(listings.problem()).contains("lacks 2 of 8 known entities of tenant 'agri' at /");

        pass(Duration.ofSeconds(60));
        assertThat(listings.isNow()).isTrue();
        assertThat(listings.deleted(of("gh"), 3)).isEqualTo(of("gh"));
        listings.done();
        assertThat(listings.isNow()).isFalse();
    }

    @Test
    void trustsAListingThatLacksHalfOrAHandful() {
        assertThat(listings.deleted(of("abcdef"), 12)).hasSize(6);
        assertThat(listings.deleted(of("abcde"), 5)).hasSize(5);
        assertThat(listings.deleted(of("abcdef"), 11)).isEmpty();
    }

    /** The context broker went away while the deletions were checked. */
    @Test
    void listsAgainIfTheDeletionsWereNotDone() {
        listings.deleted(of("abcdef"), 6);
        listings.done();
        pass(Duration.ofSeconds(60));
        listings.deleted(of("abcdef"), 6);

        assertThat(listings.isNow()).isTrue();
        assertThat(listings.deleted(of("def"), 3)).hasSize(3);
    }

    private void pass(Duration time) {
        nanos.addAndGet(time.toNanos());
    }

    private static Set<String> of(String ids) {
        return new TreeSet<>(ids.chars().mapToObj(Character::toString).toList());
    }
}
