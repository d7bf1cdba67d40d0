package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.SplittableRandom;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.simulators.scenario.SimulatedDevice;

import static org.assertj.core.api.Assertions.assertThat;

class ReportSchedulerTest {
    private static final Instant START = Instant.parse("2026-06-01T08:00:00Z");

    @ParameterizedTest
    @ValueSource(longs = {1, 2, 3, 4, 5})
    void letsEachDeviceReportOnceInItsPeriod(long seed) {
        SplittableRandom random = new SplittableRandom(seed);
        ReportScheduler scheduler = new ReportScheduler();
        for (int i = 0; i < 100; i++) {
            scheduler.add(device("d" + i, Duration.ofMillis(random.nextLong(100, 5000))), START);
        }

        Map<String, List<Instant>> reports = new HashMap<>();
        Instant before = START;
        for (ReportScheduler.Due due : until(scheduler, START.plusSeconds(60), random)) {
            assertThat(due.time()).isAfterOrEqualTo(before);
            before = due.time();
            reports.computeIfAbsent(due.device().id(), id -> new ArrayList<>()).add(due.time());
        }

        assertThat(reports).hasSize(100);
        for (int i = 0; i < 100; i++) {
            List<Instant> times = reports.get("d" + i);
            Duration period = Duration.between(times.get(0), times.get(1));
            assertThat(Duration.between(START, times.get(0))).isLessThan(period);
            assertThat(times)
                    .hasSizeBetween((int) (60_000 / period.toMillis()), 1 + (int) (60_000 / period.toMillis()));
            for (int k = 0; k < times.size(); k++) {
                assertThat(times.get(k)).isEqualTo(times.get(0).plus(period.multipliedBy(k)));
            }
        }
    }

    @Test
    void spreadsDevicesOverTheirPeriod() {
        ReportScheduler scheduler = new ReportScheduler();
        for (int i = 0; i < 1000; i++) {
            scheduler.add(device("d" + i, Duration.ofSeconds(1)), START);
        }

        int[] tenths = new int[10];
        for (ReportScheduler.Due due : until(scheduler, START.plusMillis(999), new SplittableRandom(1))) {
            tenths[(int) (Duration.between(START, due.time()).toMillis() / 100)]++;
        }

        assertThat(tenths).hasSize(10);
        for (int tenth : tenths) {
            assertThat(tenth).isBetween(95, 105);
        }
    }

    @Test
    void leavesOutWhatIsTooLate() {
        ReportScheduler scheduler = new ReportScheduler();
        scheduler.add(device("d", Duration.ofSeconds(1)), START);

        assertThat(all(scheduler, START.plusSeconds(10))).hasSize(11);
        assertThat(all(scheduler, START.plusSeconds(3610)).size()).isBetween(1, 2);
        assertThat(scheduler.next()).contains(START.plusSeconds(3611));
    }

    @Test
    void forgetsADevice() {
        ReportScheduler scheduler = new ReportScheduler();
        scheduler.add(device("a", Duration.ofSeconds(1)), START);
        scheduler.add(device("b", Duration.ofSeconds(1)), START);
        scheduler.remove("a");
        scheduler.remove("unknown");

        assertThat(all(scheduler, START.plusSeconds(5)))
                .hasSize(5)
                .allMatch(due -> due.device().id().equals("b"));
        scheduler.remove("b");
        assertThat(scheduler.next()).isEmpty();
    }

    @Test
    void hasADeviceOnceThatIsAddedTwice() {
        ReportScheduler scheduler = new ReportScheduler();
        scheduler.add(device("a", Duration.ofSeconds(1)), START);
        scheduler.add(device("a", Duration.ofSeconds(2)), START);

        assertThat(all(scheduler, START.plusSeconds(10))).hasSize(5);
    }

    private static List<ReportScheduler.Due> all(ReportScheduler scheduler, Instant end) {
        List<ReportScheduler.Due> taken = new ArrayList<>();
        for (Optional<ReportScheduler.Due> due = scheduler.take(end); due.isPresent(); due = scheduler.take(end)) {
            taken.add(due.get());
        }
        return taken;
    }

    /** Taken at random times. */
    private static List<ReportScheduler.Due> until(ReportScheduler scheduler, Instant end, SplittableRandom random) {
        List<ReportScheduler.Due> taken = new ArrayList<>();
        for (Instant now = START; now.isBefore(end); now = now.plusMillis(random.nextLong(1, 300))) {
            taken.addAll(all(scheduler, now));
        }
        taken.addAll(all(scheduler, end));
        return taken;
    }

    private static SimulatedDevice device(String id, Duration period) {
        return new SimulatedDevice.Sensor(
                new SimulatedDevice.Identity(id, "urn:" + id, "Thermometer", "farm", "weeding"),
                period,
                null,
                List.of());
    }
}
