package io.furrow.connect.sink.api;

import java.time.Duration;
import java.util.concurrent.atomic.AtomicLong;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class EntityTimesCacheTest {
    private static final EntityKey A = new EntityKey(FiwareScope.DEFAULT, "a");

    private final AtomicLong nanos = new AtomicLong(Long.MAX_VALUE - 5);
    private final EntityTimesCache known = new EntityTimesCache(100, Duration.ofNanos(10), nanos::get);

    @Test
    void areFreshUntilTheyAreTooOldWhateverWasWrittenSince() {
        assertThat(known.isFresh(A)).isFalse();

        known.learn(A, new EntityTimes());
        nanos.addAndGet(9);
        known.set(A, "T", "x", 5);
        assertThat(known.isFresh(A)).isTrue();

        nanos.addAndGet(1);
        assertThat(known.isFresh(A)).isFalse();
        assertThat(known.of(A).of("T", "x")).as("until they are read").isEqualTo(5);
    }

    @Test
    void giveWayToWhatIsReadButForDeletions() {
        known.learn(A, new EntityTimes());
        known.set(A, "T", "x", 5);
        known.delete(new EntityChange(A, "T", null, 7, 0));
        EntityTimes read = new EntityTimes();
        read.put("T", "x", 9);

        known.learn(A, read);

        assertThat(known.of(A).of("T", "x")).isEqualTo(9);
        assertThat(known.of(A).deletedAt("T")).isEqualTo(7);
        assertThat(known.of(A).deletedAt("U")).isEqualTo(EntityChange.NO_TIME);
        assertThat(known.size()).isEqualTo(3);
    }
}
