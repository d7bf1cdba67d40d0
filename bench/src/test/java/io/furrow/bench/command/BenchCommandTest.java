package io.furrow.bench.command;

import java.io.PrintWriter;
import java.io.StringWriter;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.launcher.Furrow;

import static org.assertj.core.api.Assertions.assertThat;

class BenchCommandTest {
    @ParameterizedTest
    @CsvSource({
        "bench --help, load",
        "bench load --help, --devices",
        "bench notifications --help, --new-connections",
        "bench sink --help, --stand-in",
        "bench control --help, --outstanding",
        "bench whole --help, --against",
        "bench evaluate --help, --sweeps",
        "bench --help, dashboard",
        "bench dashboard --help, ./furrow soak page --help"
    })
    void explainsItself(String words, String mentioned) {
        StringWriter out = new StringWriter();

        int code = Furrow.commandLine()
                .addSubcommand(new BenchCommand())
                .setOut(new PrintWriter(out))
                .execute(words.split(" "));

        assertThat(code).isZero();
        assertThat(out.toString()).contains(mentioned);
    }
}
