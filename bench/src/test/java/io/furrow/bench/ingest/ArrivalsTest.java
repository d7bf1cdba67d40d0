package io.furrow.bench.ingest;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

class ArrivalsTest {
    private static final long SECOND = 1_000_000_000L;

    private final Arrivals arrivals = new Arrivals(1000);

    @Test
    void leaveTheStartAndTheWaitForTheLastCheckpointOut() {
        arrivals.add(0, 0, 0);
        arrivals.add(10 * SECOND, 5 * SECOND, 300); // committed together
        arrivals.add(11 * SECOND, 6 * SECOND, 600);
        arrivals.add(12 * SECOND, 7 * SECOND, 900);
        arrivals.add(20 * SECOND, 8 * SECOND, 1000);

        Arrivals.Pace pace = arrivals.pace();

        assertThat(pace.perSecond()).isEqualTo(300, within(1e-9));
        assertThat(pace.processorMicrosEach()).isEqualTo(2e6 / 600, within(1e-9));
    }

    @Test
    void tellNoPaceOfWhatCameAtOnce() {
        arrivals.add(0, 0, 0);
        arrivals.add(SECOND, SECOND, 1000);

        assertThat(arrivals.areAll()).isTrue();
        assertThatThrownBy(arrivals::pace)
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("all records came at once; measure more of them (--records)");
    }
}
