package io.furrow.bench.notifications;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.time.Duration;
import java.util.BitSet;
import java.util.List;
import java.util.Map;

import org.HdrHistogram.Histogram;
import org.junit.jupiter.api.Test;

import io.furrow.bench.http.HttpLoad;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class NotificationReportTest {
    private static final HttpLoad.Plan PLAN = new HttpLoad.Plan(64, false, 0, 1000, 10, Duration.ofSeconds(1));

    private final NotificationReport report =
            new NotificationReport(PLAN, "/data, on ext4", List.of(run(3000, 2), run(1000, 0), run(2000, 0)));

    @Test
    void showsTheMedianOfEachFigure() {
        assertThat(report.median(NotificationReport.Run::perSecond)).isEqualTo(2000, within(1e-6));
        assertThat(report.json().path("median").path("answeredPerSecond").asDouble())
                .isEqualTo(2000, within(1e-6));
        assertThat(report.json().path("runs")).hasSize(3);
    }

    @Test
    void addsUpWhatIsMissingInAnyRun() {
        assertThat(report.missing()).isEqualTo(2);
    }

    @Test
    void setsARateInRelationToWhatWasMeasuredBesideIt() {
        NotificationReport.Run run = run(1000, 0);

        assertThat(run.ofBareServer()).isEqualTo(0.1, within(1e-6));
        assertThat(run.ofBareBridge()).isEqualTo(0.25, within(1e-6));
        assertThat(run.ofProducer()).isEqualTo(0.02, within(1e-6));
        assertThat(run.cpuMicros("listener")).isEqualTo(50, within(1e-6));
    }

    @Test
    void countsNoMoreThanWhatIsInKafkaToo() {
        HttpLoad.Result load = load(1000);

        assertThat(new NotificationReport.Run(load, 400, 0, 0, Map.of(), load, load, 1).perSecond())
                .isEqualTo(400);
    }

    @Test
    void printsALineForEachRunAndOneForTheMedian() {
        StringWriter out = new StringWriter();

        report.print(new PrintWriter(out));

        assertThat(out.toString())
                .startsWith(
                        "Notifications of 1000 bytes over 64 kept connections, as fast as they are answered, 1 s a run")
                .contains("journal in /data, on ext4")
                .containsPattern("(?m)^1 +3000 +3000")
                .containsPattern("(?m)^median +2000 +2000")
                .containsPattern("listener +25.0");
    }

    /** One second of this many notifications, and 50 ms of a listener's processor time. */
    private static NotificationReport.Run run(int count, long missing) {
        return new NotificationReport.Run(
                load(count), count, missing, 0, Map.of("listener", 50_000_000L), load(10_000), load(4_000), 50_000);
    }

    private static HttpLoad.Result load(int count) {
        Histogram latency = new Histogram(1_000_000, 3);
        latency.recordValueWithCount(5000, count);
        return new HttpLoad.Result(0, new BitSet(), 0, 0, latency, 1_000_000_000L);
    }
}
