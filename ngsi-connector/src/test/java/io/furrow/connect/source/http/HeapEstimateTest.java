package io.furrow.connect.source.http;

import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class HeapEstimateTest {
    private static final String EMPTY = "{\"data\": []}";

    @Test
    void growsWithTheValuesOfATree() {
        assertThat(of("{\"data\": [" + "0,".repeat(1000) + "0]}"))
                .isGreaterThan(of(EMPTY) + 1000 * 90)
                .isLessThan(of(EMPTY) + 1000 * 150);
        assertThat(of("{\"id\": \"" + "x".repeat(2000) + "\"}")).isLessThan(of(EMPTY) + 2000 * 10);
    }

    @Test
    void growsWithTheEntitiesAndNotWithTheObjectsInTheirValues() {
        String entity = "{\"id\": \"a\"}";
        long values = of("{\"data\": [{\"id\": \"a\", \"x\": [" + (entity + ",").repeat(99) + entity + "]}]}");

        assertThat(of("{\"data\": [" + (entity + ",").repeat(99) + entity + "]}"))
                .isGreaterThan(values + 100_000);
        assertThat(of("{\"type\": \"Notification\", \"data\": {\"features\": [" + (entity + ",").repeat(99) + entity
                        + "]}}"))
                .isGreaterThan(values + 100_000);
    }

    @Test
    void isNotDeceivedByTexts() {
        String brackets = "{\"x\": \"" + "]}\\\"\\\\".repeat(100) + "\", \"data\": [";
        long none = of(brackets + "]}");

        assertThat(of(brackets + "{},".repeat(100) + "{}]}")).isGreaterThan(none + 100 * 3000);
    }

    @Test
    void existsForWhatIsNoJson() {
        assertThat(of("]]]}\"")).isPositive();
        assertThat(of("")).isPositive();
        assertThat(of("\"\\")).isPositive();
    }

    private static long of(String json) {
        return HeapEstimate.of(json.getBytes(UTF_8));
    }
}
