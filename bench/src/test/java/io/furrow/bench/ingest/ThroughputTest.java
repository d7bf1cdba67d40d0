package io.furrow.bench.ingest;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

class ThroughputTest {
    private static final long SECOND = 1_000_000_000L;

    private final Throughput throughput = new Throughput(1000);

    @Test
    void leaveTheStartAndTheWaitForTheLastCheckpointOut() {
        throughput.add(0, 0, 0);
        throughput.add(10 * SECOND, 5 * SECOND, 300); // committed together
        throughput.add(11 * SECOND, 6 * SECOND, 600);
        throughput.add(12 * SECOND, 7 * SECOND, 900);
        throughput.add(20 * SECOND, 8 * SECOND, 1000);

        Throughput.Pace pace = throughput.pace();

        assertThat(pace.perSecond()).isEqualTo(300, within(1e-9));
        assertThat(pace.processorMicrosEach()).isEqualTo(2e6 / 600, within(1e-9));
    }

    @Test
    void tellNoPaceOfWhatCameAtOnce() {
        throughput.add(0, 0, 0);
        throughput.add(SECOND, SECOND, 1000);

        assertThat(throughput.areAll()).isTrue();
        assertThatThrownBy(throughput::pace)
                .isInstanceOf(IllegalStateException.class)
                .hasMessage("all records came at once; measure more of them (--records)");
    }
}
