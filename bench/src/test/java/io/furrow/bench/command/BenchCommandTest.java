package io.furrow.bench.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

import io.furrow.bench.component.Component;

import static org.assertj.core.api.Assertions.assertThat;

class BenchCommandTest {
    @ParameterizedTest
    @CsvSource({
        "bench --help, load", "bench load --help, --devices", "bench notifications --help, --new-connections",
        "bench sink --help, --stand-in", "bench control --help, --outstanding", "bench whole --help, --against",
        "bench evaluate --help, --sweeps", "bench components --help, --turns", "bench compare --help, BEFORE",
        "bench --help, dashboard", "bench dashboard --help, ./furrow soak page --help"
    })
    void explainsItself(String words, String mentioned) {
        StringWriter out = new StringWriter();

        int code = BenchCommand.commandLine().setOut(new PrintWriter(out)).execute(words.split(" "));

        assertThat(code).isZero();
        assertThat(out.toString()).contains(mentioned);
    }

    @ParameterizedTest
    @EnumSource
    void hasTheOptionsThatComponentsAreMeasuredWith(Component component) {
        List<String> words = new ArrayList<>(List.of("bench"));
        words.addAll(component.words());
        words.addAll(List.of("--output", "file"));

        assertThat(BenchCommand.commandLine()
                        .parseArgs(words.toArray(String[]::new))
                        .errors())
                .isEmpty();
    }
}
