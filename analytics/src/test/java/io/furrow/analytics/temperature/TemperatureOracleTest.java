package io.furrow.analytics.temperature;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.LongStream;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.flink.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

/** The job against a recomputation in one pass over lists that shares no code with it. A seed makes a whole case. */
@Timeout(120)
class TemperatureOracleTest {
    private static final int CASES = 30;

    @RegisterExtension
    static final MiniClusterExtension FLINK = InTurn.cluster(2);

    @TempDir
    private Path dir;

    static LongStream seeds() {
        return LongStream.range(0, CASES);
    }

    @ParameterizedTest(name = "seed {0}")
    @MethodSource("seeds")
    void agreesWithABatchRecomputation(long seed) throws Exception {
        RandomCase random = RandomCase.of(seed);
        Path fields = Files.writeString(dir.resolve("fields.geojson"), random.geoJson());

        BatchRecomputation expected = BatchRecomputation.of(random);
        JobRun run = JobRun.over(random.arrivals(), Farm.options(fields, random.arguments()));

        List<Entity> results = run.results(Topics.TEMPERATURE);
        assertThat(results)
                .extracting(TemperatureOracleTest::fieldAndWindow)
                .containsExactlyInAnyOrderElementsOf(expected.results().keySet());
        for (Entity result : results) {
            compare(result, expected.results().get(fieldAndWindow(result)));
        }
        assertThat(run.to(Topics.TEMPERATURE_LATE))
                .extracting(TemperatureOracleTest::fieldAndId)
                .containsExactlyInAnyOrderElementsOf(expected.late());
    }

    @Test
    void hasCasesOfEveryKind() {
        List<BatchRecomputation> cases = seeds().mapToObj(seed -> BatchRecomputation.of(RandomCase.of(seed)))
                .toList();

        assertThat(cases.stream().mapToInt(each -> each.late().size())).anyMatch(late -> late > 0);
        assertThat(cases.stream().flatMap(each -> each.results().values().stream()))
                .anyMatch(result -> !result.get("suspects").equals("[]"))
                .anyMatch(result -> result.get("quality").equals("unverified"))
                .anyMatch(result -> result.get("quality").equals("robust"));
    }

    private static void compare(Entity result, Map<String, Object> expected) {
        for (String number : List.of("averageTemperature", "plainMean", "spread")) {
            assertThat(result.number(number).orElseThrow())
                    .as(number)
                    .isCloseTo((double) expected.get(number), within(1e-9));
        }
        assertThat(result.number("devices")).contains((double) (int) expected.get("devices"));
        assertThat(result.value("suspects").orElseThrow().toString()).isEqualTo(expected.get("suspects"));
        assertThat(result.text("quality")).contains((String) expected.get("quality"));
    }

    private static String fieldAndWindow(Entity result) {
        return result.text("field").orElseThrow() + " "
                + result.value("windowStart").orElseThrow().longValue() + " "
                + result.value("windowEnd").orElseThrow().longValue();
    }

    private static String fieldAndId(TopicRecord late) {
        return late.headers().get("late-field") + " " + late.headers().get(HeaderNames.CE_ID);
    }
}
