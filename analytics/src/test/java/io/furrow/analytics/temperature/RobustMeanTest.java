package io.furrow.analytics.temperature;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.stream.Collectors;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.aggregator.ArgumentsAccessor;
import org.junit.jupiter.params.provider.CsvFileSource;

import io.furrow.analytics.Seeds;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

class RobustMeanTest {
    @ParameterizedTest(name = "{0}")
    @CsvFileSource(resources = "/temperature/robust-means.csv", delimiter = ';', numLinesToSkip = 1)
    void isAsTheTableSays(ArgumentsAccessor row) {
        RobustMean mean = RobustMean.of(votes(row.getString(1)), row.getDouble(2));

        assertThat(mean.mean()).isCloseTo(row.getDouble(3), within(1e-9));
        assertThat(mean.plainMean()).isCloseTo(row.getDouble(4), within(1e-9));
        assertThat(mean.spread()).isCloseTo(row.getDouble(5), within(1e-9));
        assertThat(mean.suspects()).isEqualTo(words(row.getString(6)));
        assertThat(mean.verified()).isEqualTo(row.getBoolean(7));
        assertThat(mean.devices()).isEqualTo(words(row.getString(1)).size());
    }

    @Test
    void isTheSameToTheLastBitInWhateverOrderTheVotesCame() {
        Random random = new Random(7);
        List<Map.Entry<String, Double>> votes = new ArrayList<>();
        for (int i = 0; i < 50; i++) {
            votes.add(Map.entry("device-" + i, 18 + random.nextGaussian()));
        }
        RobustMean first = RobustMean.of(inOrder(votes), 0.5);

        for (int i = 0; i < 20; i++) {
            Collections.shuffle(votes, random);
            assertThat(RobustMean.of(inOrder(votes), 0.5)).isEqualTo(first);
        }
    }

    /** Votes of few values, so that many are alike and many are as far from the median on both sides. */
    @Test
    void setsDevicesOfTheSameVoteAsideTogetherAndAveragesTheOthers() {
        Random random = Seeds.random(11);
        for (int i = 0; i < 20_000; i++) {
            Map<String, Double> votes = new LinkedHashMap<>();
            int devices = 1 + random.nextInt(12);
            for (int device = 0; device < devices; device++) {
                double vote = random.nextInt(4) == 0 ? random.nextInt(40) : random.nextInt(4);
                votes.put("device-" + device, 18 + vote / 4);
            }
            RobustMean mean = RobustMean.of(votes, i % 2 == 0 ? 0 : 0.5);

            Map<Boolean, Set<Double>> values = votes.entrySet().stream()
                    .collect(Collectors.partitioningBy(
                            vote -> mean.suspects().contains(vote.getKey()),
                            Collectors.mapping(Map.Entry::getValue, Collectors.toSet())));
            assertThat(values.get(true)).doesNotContainAnyElementsOf(values.get(false));
            assertThat(mean.suspects()).hasSizeLessThan((devices + 1) / 2);
            assertThat(mean.mean())
                    .isCloseTo(
                            votes.entrySet().stream()
                                    .filter(vote -> !mean.suspects().contains(vote.getKey()))
                                    .mapToDouble(Map.Entry::getValue)
                                    .average()
                                    .orElseThrow(),
                            within(1e-9));
        }
    }

    @Test
    void doesNotExistWithoutVotes() {
        assertThatThrownBy(() -> RobustMean.of(Map.of(), 0))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("no values have no median");
    }

    private static Map<String, Double> votes(String text) {
        Map<String, Double> votes = new LinkedHashMap<>();
        for (String vote : words(text)) {
            votes.put(vote.substring(0, vote.indexOf('=')), Double.valueOf(vote.substring(vote.indexOf('=') + 1)));
        }
        return votes;
    }

    private static Map<String, Double> inOrder(List<Map.Entry<String, Double>> votes) {
        Map<String, Double> ordered = new LinkedHashMap<>();
        votes.forEach(vote -> ordered.put(vote.getKey(), vote.getValue()));
        return ordered;
    }

    private static List<String> words(String text) {
        return text == null ? List.of() : List.of(text.split(" "));
    }
}
