package io.furrow.bench.component;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.DoubleStream;

import com.fasterxml.jackson.databind.ObjectMapper;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.bench.component.Component.Rates;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ComparisonTest {
    @Test
    void tellsAChangeFromNoise() {
        assertThat(verdict(turns(50, 52, 48), turns(60, 61, 59))).isEqualTo("faster");
        assertThat(verdict(turns(50, 52, 48), turns(40, 41, 47))).isEqualTo("slower");
        assertThat(verdict(turns(50, 52, 48), turns(60, 61, 51))).startsWith("noise");
        assertThat(verdict(turns(50, 50, 50), turns(52, 52, 52))).isEqualTo("the same");
        assertThat(verdict(turns(50, 52), turns(60, 61, 59))).startsWith("too few turns (2 and 3");
    }

    @Test
    void comparesWithThePeerOfTheSameMinutes() {
        List<Rates> slowHour = List.of(rates(25, 50), rates(26, 52), rates(24, 48));

        Comparison comparison = new Comparison(turns(50, 52, 48), slowHour);

        assertThat(comparison.ratio()).isEqualTo(1);
        assertThat(comparison.verdict()).isEqualTo("the same");
    }

    @Test
    void hasTheTurnsOfTheCommitThatWasMeasuredLast(@TempDir Path folder) throws Exception {
        Path file = folder.resolve("results.jsonl");
        ComponentResults results = ComponentResults.in(file);
        results.add("old", 1, Component.SINK, rates(1, 2));
        results.add("new", 1, Component.SINK, new Rates(3, 4, Map.of("another", 5.0)));

        ComponentResults known = ComponentResults.in(file);

        assertThat(known.commit()).isEqualTo("new");
        assertThat(known.of(Component.SINK)).containsExactly(new Rates(3, 4, Map.of("another", 5.0)));
        assertThat(known.has("old", 1, Component.SINK)).isTrue();
        assertThat(known.has("old", 2, Component.SINK)).isFalse();
        Files.writeString(file, "hello\n");
        assertThatThrownBy(() -> ComponentResults.in(file)).hasMessageContaining("bench components");
    }

    @Test
    void findsTheFiguresOfABench() throws Exception {
        String output = "{\"memory\":[{\"devices\":10000,\"updates/s\":900.5,\"bare loop\":1801.0}]}";

        Rates alone = Component.COLLISION.rates(new ObjectMapper().readTree(output));
        assertThat(alone).isEqualTo(rates(900.5, 1801));
        assertThat(Component.COLLISION.others(List.of(alone))).isEqualTo(Map.of("Redis GEO", Double.NaN));
        Rates both =
                Component.COLLISION.rates(new ObjectMapper().readTree(output.replace("}]", ",\"Redis GEO\":99.0}]")));
        assertThat(Component.COLLISION.others(List.of(both))).isEqualTo(Map.of("Redis GEO", 99.0));
        assertThatThrownBy(() -> Component.SINK.rates(new ObjectMapper().readTree("[]")))
                .hasMessageContaining("the bench sink has no figure");
    }

    private static String verdict(List<Rates> before, List<Rates> now) {
        return new Comparison(before, now).verdict();
    }

    private static Rates rates(double ours, double peers) {
        return new Rates(ours, peers, Map.of());
    }

    /** Beside a peer of 100. */
    private static List<Rates> turns(double... ours) {
        return DoubleStream.of(ours).mapToObj(each -> rates(each, 100)).toList();
    }
}
