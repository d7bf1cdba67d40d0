package io.furrow.bench.evaluation;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import javax.imageio.ImageIO;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.bench.evaluation.Sweep.Point;
import io.furrow.bench.load.Hop;
import io.furrow.bench.load.LoadSecond;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EvaluationReportTest {
    private static final EvaluationResults.Run RUN = new EvaluationResults.Run("0123abc", 1024, 60);

    @Test
    void hasTheRatesOfTheThesis() {
        assertThat(Sweep.PERIOD.points())
                .extracting(Point::rate)
                .containsExactly(5.0, 50.0, 125.0, 250.0, 500.0, 625.0);
        assertThat(Sweep.DEVICES.points())
                .extracting(Point::rate)
                .containsExactly(5.0, 50.0, 125.0, 250.0, 500.0, 625.0);
        assertThat(Sweep.PAYLOAD.points())
                .extracting(Point::abscissa)
                .containsExactly(1.0, 10.0, 50.0, 65.0, 80.0, 100.0);
        assertThat(Sweep.SUBSCRIPTIONS.points())
                .extracting(Point::rate)
                .startsWith(125.0, 250.0)
                .endsWith(750.0, 3750.0);
    }

    @Test
    void continuesWithTwiceTheLoad() {
        assertThat(Sweep.PERIOD.further(point(Sweep.PERIOD, 5)).rate()).isEqualTo(1250);
        assertThat(Sweep.PERIOD.further(new Point(Sweep.PERIOD, 5, 1, 1_000, 1)))
                .isNull();
        assertThat(Sweep.DEVICES.further(point(Sweep.DEVICES, 5)).rate()).isEqualTo(1250);
        assertThat(Sweep.PAYLOAD.further(point(Sweep.PAYLOAD, 5)).abscissa()).isEqualTo(200);
        assertThat(Sweep.SUBSCRIPTIONS.further(point(Sweep.SUBSCRIPTIONS, 6)).rate())
                .isEqualTo(7500);
    }

    @Test
    void holdsIfAllMessagesAreSentAndArriveWithinASecond() {
        Point point = point(Sweep.DEVICES, 1);
        assertThat(result(point, 100, 0).holds()).isTrue();
        assertThat(result(point, 99, 0).limit()).isEqualTo("0.9900 delivered");
        assertThat(result(point, 100, 0, 1_001, 59).limit()).isEqualTo("p99 1,001 ms");
        assertThat(result(point, 100, 0, 1_000, 60).holds()).isTrue();
        PointResult slow = result(point, 100, 0, 1_000, 80);
        assertThat(slow.holds()).isFalse();
        assertThat(slow.limit()).isEqualTo("0.75 of it could be sent");
    }

    private static Point point(Sweep sweep, int number) {
        return sweep.points().get(number);
    }

    @Test
    void reusesPointsOfAnEarlierRunWithTheSameSettings(@TempDir Path folder) throws Exception {
        Path file = folder.resolve("results.jsonl");
        Point point = Sweep.PERIOD.points().get(2);
        EvaluationResults.in(file).add(result(point, 100, 0));

        EvaluationResults stored = EvaluationResults.in(file);

        assertThat(stored.of(new EvaluationResults.Run("another", 1024, 60), point))
                .isNull();
        assertThat(stored.of(new EvaluationResults.Run(RUN.commit(), 4096, 60), point))
                .isNull();
        assertThat(stored.of(new EvaluationResults.Run(RUN.commit(), 1024, 4), point))
                .isNull();
        assertThat(stored.of(RUN, point)).isEqualTo(result(point, 100, 0));
        assertThat(stored.of(RUN, Sweep.PERIOD)).containsExactly(result(point, 100, 0));
    }

    @Test
    void rejectsAFileWithOtherContent(@TempDir Path folder) throws Exception {
        Path file = Files.writeString(folder.resolve("other.jsonl"), "hello\n");

        assertThatThrownBy(() -> EvaluationResults.in(file)).hasMessageContaining("--results");
    }

    @Test
    void marksPointsWithLossOrDuplicatesAndDrawsPlots(@TempDir Path folder) throws Exception {
        EvaluationResults stored = EvaluationResults.in(folder.resolve("results.jsonl"));
        stored.add(result(Sweep.PAYLOAD.points().get(0), 100, 0));
        stored.add(result(Sweep.PAYLOAD.points().get(1), 99, 0));
        stored.add(result(Sweep.PAYLOAD.points().get(2), 100, 1));

        new EvaluationReport(stored, RUN, List.of("a machine")).write(folder);

        assertThat(Files.readAllLines(folder.resolve("evaluation.md")))
                .contains("- a machine")
                .anyMatch(line -> line.startsWith("| 1 kB | 250 | 100 | 100 | 1.0000 | 0 |"))
                .anyMatch(line -> line.startsWith("| 10 kB ⚠ | 250 | 100 | 99 | 0.9900 | 0 |"))
                .anyMatch(line -> line.startsWith("| 50 kB ⚠ | 250 | 100 | 100 | 1.0000 | 1 |"))
                .contains(
                        "| larger messages of 50 devices | 1 kB | 250 | 30 | 10 kB | 0.9900 delivered | 2 | Kafka broker (0.20 cores) |")
                .contains("![Delay from device to reader](images/evaluation-delay.png)");
        assertThat(Files.readString(folder.resolve("report.html")))
                .contains("src=\"data:image/png;base64,iVBOR")
                .contains("<td>larger messages of 50 devices</td><td>1 kB</td>")
                .contains("<tr><td>10 kB ⚠</td><td>250</td>");
        for (String name : List.of("delivered", "delay", "cores", "payload-messages", "payload-hops")) {
            int[] pixels = pixels(folder.resolve("images").resolve("evaluation-" + name + ".png"));
            assertThat(Arrays.stream(pixels).distinct().count()).as(name).isGreaterThan(10);
        }
    }

    private static int[] pixels(Path file) throws Exception {
        var image = ImageIO.read(file.toFile());
        return image.getRGB(0, 0, image.getWidth(), image.getHeight(), null, 0, image.getWidth());
    }

    private static PointResult result(Point point, long delivered, long duplicated) {
        return result(point, delivered, duplicated, 30, 59);
    }

    /** @param last the last second with a sent message */
    private static PointResult result(Point point, long delivered, long duplicated, long p99, long last) {
        Map<Hop, PointResult.Delay> delays = new EnumMap<>(Hop.class);
        for (Hop hop : Hop.values()) {
            delays.put(hop, new PointResult.Delay(10, 9, 20, p99, 40, ""));
        }
        List<LoadSecond> seconds = List.of(
                new LoadSecond(0, 20, 20, 20, 20, List.of(1.0, 2.0, 3.0)),
                new LoadSecond(1, 50, 50, 50, 50, List.of(2.0, 3.0, 4.0)),
                new LoadSecond(2, 50, 40, 40, 40, List.of(3.0, 4.0, 5.0)),
                new LoadSecond(3, 0, 10, 10, 10, List.of()),
                new LoadSecond(last, 1, 1, 1, 1, List.of(1.0, 2.0, 3.0)));
        return new PointResult(
                RUN.commit(),
                RUN.heap(),
                point,
                60,
                100,
                delivered,
                delivered,
                duplicated,
                0,
                delays,
                seconds,
                Map.of("Kafka broker", 0.2),
                1_000_000_000);
    }
}
