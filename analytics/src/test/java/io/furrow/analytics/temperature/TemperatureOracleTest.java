package io.furrow.analytics.temperature;

import java.util.List;
import java.util.Map;
import java.util.stream.LongStream;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

/**
 * The job against a recomputation in one skip lists that shares no code with it. A seed makes ten whole cases that run as one
 * job; those without late readings with one, two and four subtasks.
 */
@Timeout(120)
@Tag("full")
class TemperatureOracleTest {
    private static final int CASES = Integer.getInteger("furrow.oracle.cases", 200);
    private static final int[] PARALLELISM = {1, 2, 4};

    @RegisterExtension
    static final MiniClusterExtension FLINK = InTurn.cluster(4);

    static LongStream seeds() {
        return LongStream.range(0, CASES / RandomCases.TOGETHER);
    }

    @ParameterizedTest(name = "seed {0}")
    @MethodSource("seeds")
    void agreesWithABatchRecomputation(long seed) throws Exception {
        RandomCases random = RandomCases.of(seed, PARALLELISM[(int) (seed / 2 % PARALLELISM.length)]);
        BatchRecomputation expected = BatchRecomputation.of(random);
        JobRun run = JobRun.over(random);

        List<Entity> results = run.results(Topics.TEMPERATURE);
        Map<String, Map<String, Object>> expectedResults = expected.results();
        assertThat(results)
                .extracting(TemperatureOracleTest::fieldAndWindow)
                .containsExactlyInAnyOrderElementsOf(expectedResults.keySet());
        for (Entity result : results) {
            compare(result, expectedResults.get(fieldAndWindow(result)));
        }
        assertThat(run.to(Topics.TEMPERATURE_LATE))
                .extracting(TemperatureOracleTest::fieldAndId)
                .containsExactlyInAnyOrderElementsOf(expected.late());
    }

    @Test
    void hasCasesOfEveryKind() {
        List<RandomCases> random =
                seeds().mapToObj(seed -> RandomCases.of(seed, 1)).toList();
        var cases = random.stream().map(BatchRecomputation::of).toList();

        assertThat(cases.stream().mapToInt(each -> each.late().size())).anyMatch(late -> late > 0);
        assertThat(cases.stream().flatMap(each -> each.results().values().stream()))
                .anyMatch(result -> !result.get("suspects").equals("[]"))
                .anyMatch(result -> result.get("quality").equals("unverified"))
                .anyMatch(result -> result.get("quality").equals("robust"))
                .anyMatch(result -> result.get("Domain").equals("d1"));
        assertThat(random.stream().flatMap(each -> each.changes().stream()))
                .anyMatch(RandomCases.Change::taken)
                .anyMatch(change -> change.before() > 0 && change.shape() == null && !change.taken())
                .anyMatch(change -> change.before() > 0 && change.shape() != null);
        assertThat(random.stream()
                        .flatMap(each -> each.changes().stream())
                        .filter(change -> change.shape() != null)
                        .map(RandomCases.Change::shape))
                .anyMatch(shape -> shape.parts().size() == 2)
                .anyMatch(shape -> shape.parts().get(0).size() == 2);
    }

    private static void compare(Entity result, Map<String, Object> expected) {
        for (String number : List.of("averageTemperature", "plainMean", "spread")) {
            if (expected.containsKey(number)) {
                assertThat(result.number(number).orElseThrow())
                        .as(number)
                        .isCloseTo((double) expected.get(number), within(1e-9));
            } else {
                assertThat(result.json().path(number).path("value").isNull())
                        .as(number)
                        .isTrue();
            }
        }
        assertThat(result.number("devices")).contains((double) (int) expected.get("devices"));
        assertThat(result.value("suspects").orElseThrow().toString()).isEqualTo(expected.get("suspects"));
        assertThat(result.text("quality")).contains((String) expected.get("quality"));
        assertThat(result.text("Domain").orElse("")).isEqualTo(expected.get("Domain"));
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
