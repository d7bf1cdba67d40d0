package io.furrow.bench.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.atomic.AtomicLong;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class ControlMeasurementTest {
    private static final ControlMeasurement.Plan PLAN = new ControlMeasurement.Plan(0, 10, Duration.ofMillis(200));

    private final List<String> ids = new ArrayList<>();
    private final AtomicLong repeats = new AtomicLong();
    private boolean repeatOne;

    @Test
    void countsRequestsThatAreAnsweredAsTheyShould() throws Exception {
        var report = new ControlMeasurement(client("changed", "created", "deleted"), "run").run(PLAN);

        assertThat(report.sent()).isPositive().isEqualTo(report.answered()).isEqualTo(ids.size());
        assertThat(report.isSound()).isTrue();
        assertThat(report.delays().getTotalCount()).isEqualTo(report.sent());
        assertThat(ids).doesNotHaveDuplicates().first().isEqualTo("run-0");
    }

    @Test
    void tellsOfAnswersThatAreWrong() throws Exception {
        ControlMeasurement.Report report = new ControlMeasurement(client("error"), "run").run(PLAN);

        assertThat(report.answered()).isEqualTo(report.sent());
        assertThat(report.unexpected()).isEqualTo(report.sent());
        assertThat(report.isSound()).isFalse();
    }

    @Test
    void tellsOfAnswersThatComeTwice() throws Exception {
        repeats.set(7); // of an earlier load
        ControlClient client = client("changed", "created", "deleted");
        ControlMeasurement measurement = new ControlMeasurement(client, "run");
        assertThat(measurement.run(PLAN).isSound()).isTrue();
        repeatOne = true;
        assertThat(measurement.run(PLAN).repeats()).isEqualTo(1);
    }

    /** The steps of a mission are further from each other than requests may wait. */
    @Test
    void asksForTheStepsOfAMissionInOrder() {
        Map<String, List<String>> commands = new HashMap<>();
        Map<String, Long> last = new HashMap<>();
        for (long number = 0; number < 40_000; number++) {
            ControlRequest request = ControlRequest.of(number, "r");
            String mission = request.members().path("mission").asText();
            if (!mission.isEmpty()) {
                commands.computeIfAbsent(mission, any -> new ArrayList<>()).add(request.command());
                Long before = last.put(mission, number);
                assertThat(before == null || number - before > ControlRequest.OUTSTANDING)
                        .isTrue();
            }
        }
        assertThat(commands.get("bench-r-0")).containsExactly("start", "stop", "delete");
        assertThat(commands.get("bench-r-1999")).containsExactly("start", "stop", "delete");
        assertThat(commands.get("bench-r-2000")).containsExactly("start", "stop", "delete");
    }

    private ControlClient client(String... statuses) {
        return new ControlClient() {
            @Override
            public CompletableFuture<String> ask(ControlRequest request, String id) {
                ids.add(id);
                if (repeatOne) {
                    repeats.incrementAndGet();
                    repeatOne = false;
                }
                String status = List.of(statuses).contains(request.expected()) ? request.expected() : statuses[0];
                return CompletableFuture.completedFuture(status);
            }

            @Override
            public long repeats() {
                return repeats.get();
            }

            @Override
            public void close() {
                // There is nothing to close.
            }
        };
    }
}
