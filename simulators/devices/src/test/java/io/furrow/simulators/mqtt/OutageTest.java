package io.furrow.simulators.mqtt;

import java.util.concurrent.atomic.AtomicLong;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class OutageTest {
    private final AtomicLong nanoTime = new AtomicLong(-5);
    private final Outage outage = new Outage(nanoTime::get);

    @Test
    void reportsALongOneOnce() {
        outage.begin("line", "cut");
        assertThat(after(Outage.LONG.toNanos())).isFalse();
        assertThat(after(1)).isTrue();
        assertThat(after(Outage.LONG.toNanos())).isFalse();

        outage.begin("line", "cut");
        assertThat(after(Outage.LONG.toNanos() + 1)).isTrue();
    }

    @Test
    void reportsNoneThatEndedBefore() {
        assertThat(after(Outage.LONG.toNanos() + 1)).isFalse();
        outage.begin("line", "cut");
        outage.end();
        assertThat(after(Outage.LONG.toNanos() + 1)).isFalse();
    }

    private boolean after(long nanos) {
        nanoTime.addAndGet(nanos);
        return outage.isToBeReported();
    }
}
