package io.furrow.bench.whole;

import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class ThreadTimesTest {
    @ParameterizedTest
    @CsvSource({
        "C2 CompilerThre, compilers of the JVM",
        "data-plane-kafk, Kafka broker",
        "Source Data Fet, Flink: readers of Kafka",
        "Source: Reporte, Flink: operators",
        "somebody, everything else"
    })
    void knowsWhatAThreadDoes(String thread, String role) {
        assertThat(ThreadTimes.role(thread)).isEqualTo(role);
    }

    @Test
    void countsThisProcess() throws Exception {
        ThreadTimes before = ThreadTimes.of(ProcessHandle.current().pid());
        long end = System.nanoTime() + 50_000_000;
        while (System.nanoTime() < end) {
            Thread.onSpinWait();
        }

        Map<String, Long> spent =
                ThreadTimes.of(ProcessHandle.current().pid()).since(before).byRole();

        assertThat(spent.values()).allMatch(nanos -> nanos >= 0);
        assertThat(spent.get(ThreadTimes.OTHERS)).isPositive();
    }
}
