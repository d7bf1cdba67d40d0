package io.furrow.bench.whole;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Path;
import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.bench.whole.Part.Figure;

import static org.assertj.core.api.Assertions.assertThat;

class WholeResultsTest {
    private static final Checkout HERE = new Checkout("new", Path.of("a"));
    private static final Checkout OTHER = new Checkout("old", Path.of("b"));

    @TempDir
    private Path folder;

    @Test
    void printsMediansOfTheFiguresAndOfTheRatiosOfTheTurns() throws IOException {
        WholeResults results = results();
        double[][] turns = {{1, 2}, {3, 3}, {8, 4}};
        for (int turn = 0; turn < turns.length; turn++) {
            results.add(turn, Part.IDLE, HERE, Map.of(Figure.CORES, turns[turn][0]));
            results.add(turn, Part.IDLE, OTHER, Map.of(Figure.CORES, turns[turn][1]));
        }
        StringWriter table = new StringWriter();

        results.figures(HERE, OTHER).print(new PrintWriter(table));

        assertThat(table.toString().replaceAll(" +", " ")).contains("idle cores 3.00 3.00 1.00");
    }

    @Test
    void goesOnFromItsFile() throws IOException {
        results().add(1, Part.IDLE, HERE, Map.of(Figure.CORES, 0.5));

        assertThat(results().has(1, Part.IDLE, HERE)).isTrue();
        assertThat(results().has(1, Part.IDLE, OTHER)).isFalse();
        assertThat(results().has(2, Part.IDLE, HERE)).isFalse();
    }

    private WholeResults results() throws IOException {
        return WholeResults.in(folder.resolve("results.csv"));
    }
}
