package io.furrow.bench.sink;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.BitSet;
import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class SinkReportTest {
    private static final SinkReport.Plan PLAN = new SinkReport.Plan(1000, 10, 500);

    @Test
    void asksForTheNewestRecordOfEachEntityOnly() {
        BitSet arrived = new BitSet();
        arrived.set(992, 1000);

        assertThat(SinkMeasurement.missing(PLAN, arrived)).isEqualTo(2);
        arrived.set(990, 992);
        assertThat(SinkMeasurement.missing(PLAN, arrived)).isZero();
    }

    @Test
    void countsEachRecordAsAnUpdateThoughItWasMerged() {
        SinkReport report = new SinkReport("Repeated", PLAN, List.of(run(1, 0), run(2, 1), run(4, 0)));
        StringWriter out = new StringWriter();

        report.figures().print(new PrintWriter(out));

        assertThat(report.median()).isEqualTo(500, within(1e-6));
        assertThat(report.missing()).isEqualTo(1);
        assertThat(report.json().path("runs")).hasSize(3);
        assertThat(out.toString())
                .startsWith("Repeated: 1000 records of 500 bytes about 10 entities")
                .containsPattern("(?m)^2 +500 +40 +7 +1 +9000")
                .containsPattern("(?m)^median +500");
    }

    private static SinkReport.Run run(long seconds, long missing) {
        return new SinkReport.Run(seconds * 1_000_000_000L, 40, 7, missing, 9000);
    }
}
