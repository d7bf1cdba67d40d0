package io.furrow.launcher.status;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.PrintStream;
import java.util.List;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import org.jline.terminal.Attributes.LocalFlag;
import org.jline.terminal.Size;
import org.jline.terminal.Terminal.Signal;
import org.jline.terminal.impl.ExternalTerminal;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class StatusScreenTest {
    private static final String CLEAR = "\033[H\033[2J";

    private final ByteArrayOutputStream written = new ByteArrayOutputStream();

    @ParameterizedTest
    @CsvSource({"80, 24", "150, 60", "220, 60", "80, 5", "80, 1"})
    void fillsTheTerminalAtMostAndScrollsNothingAway(int columns, int rows) throws Exception {
        Screen seen = new Screen(columns, rows);
        try (StatusScreen screen = new StatusScreen(terminal(columns, rows))) {
            for (int members : new int[] {60, 3, 60, 61}) {
                screen.show(block(members)::lines);

                assertThat(seen.write(taken()).rows())
                        .isEqualTo(padded(block(members).lines(rows), rows));
            }
            screen.show(block(61)::lines);
            assertThat(taken()).as("what is there already").isEmpty();
        }
        assertThat(seen.scrolledAway()).isEmpty();
    }

    @Test
    void movesLinesUpAndDown() throws Exception {
        List<String> lines = numbered("line", 24);
        Screen seen = new Screen(80, 10);
        try (StatusScreen screen = new StatusScreen(terminal(80, 10))) {
            for (int first : new int[] {5, 6, 8, 4, 3, 11, 0}) {
                screen.show(rows -> lines.subList(first, first + rows));

                assertThat(seen.write(taken()).rows()).isEqualTo(lines.subList(first, first + 10));
            }
        }
    }

    @Test
    void cutsLinesThatAreWiderThanTheTerminal() throws Exception {
        try (StatusScreen screen = new StatusScreen(terminal(20, 3))) {
            screen.show(rows -> List.of("x".repeat(19), "y".repeat(250), "z"));

            assertThat(new Screen(20, 3).write(taken()).rows()).containsExactly("x".repeat(19), "y".repeat(19), "z");
        }
    }

    @Test
    void isDrawnAnewOnAClearedScreenWhenTheTerminalGetsAnotherSize() throws Exception {
        ExternalTerminal terminal = terminal(220, 60);
        try (StatusScreen screen = new StatusScreen(terminal)) {
            screen.show(block(60)::lines);
            for (Size size : List.of(new Size(80, 30), new Size(150, 24), new Size(0, 0))) {
                taken();
                terminal.setSize(size);
                terminal.raise(Signal.WINCH);

                int rows = size.getRows() == 0 ? 24 : size.getRows();
                String drawn = taken();
                assertThat(drawn).startsWith(CLEAR);
                assertThat(new Screen(size.getColumns() == 0 ? 80 : size.getColumns(), rows)
                                .write(drawn)
                                .rows())
                        .isEqualTo(block(60).lines(rows));
            }
        }
    }

    @Test
    void retainsWhatOthersPrintUntilTheTerminalIsGivenBack() throws Exception {
        PrintStream err = System.err;
        ByteArrayOutputStream printed = new ByteArrayOutputStream();
        System.setErr(new PrintStream(printed, true, UTF_8));
        try {
            ExternalTerminal terminal = terminal(80, 24);
            StatusScreen screen = new StatusScreen(terminal);
            assertThat(terminal.getAttributes().getLocalFlag(LocalFlag.ECHO)).isFalse();
            System.err.println("from another thread");
            System.out.println("and one more");
            assertThat(printed.toString(UTF_8)).isEmpty();

            screen.close();
            screen.close();
            screen.show(block(1)::lines);

            assertThat(printed.toString(UTF_8).lines()).containsExactly("from another thread", "and one more");
            assertThat(written.toString(UTF_8)).contains("\033[?1049l");
        } finally {
            System.setErr(err);
        }
    }

    @Test
    void leavesOutTheEndOfWhatHasNoRoomAndReportsHowMuch() {
        assertThat(block(9).lines(24))
                .containsExactly(
                        "Dashboard   http://127.0.0.1:8080   Ctrl-C stops Furrow",
                        "  a notice",
                        "averages",
                        "  average 1",
                        "  average 2",
                        "  average 3",
                        "  average 4",
                        "  … and 5 more",
                        "collisions",
                        "  collision 1",
                        "  collision 2",
                        "  collision 3",
                        "  collision 4",
                        "  … and 5 more",
                        "job                                                     to read",
                        "  job 1",
                        "  job 2",
                        "  job 3",
                        "topic                                                per second        total",
                        "  topic 1",
                        "  topic 2",
                        "  topic 3",
                        "  topic 4",
                        "  … and 26 more");
        assertThat(block(9).lines(60))
                .hasSize(40)
                .contains("  … and 21 more", "addresses")
                .endsWith("  Kafka   127.0.0.1:9092");
        assertThat(block(9).lines()).isEqualTo(block(9).lines(60));
    }

    private static StatusBlock block(int members) {
        return new StatusBlock(
                numbered("average", members),
                numbered("collision", members),
                List.of("a notice"),
                numbered("job", 3),
                numbered("topic", members),
                21,
                List.of("Dashboard   http://127.0.0.1:8080", "Kafka   127.0.0.1:9092"));
    }

    private static List<String> numbered(String name, int count) {
        return IntStream.rangeClosed(1, count).mapToObj(i -> name + " " + i).toList();
    }

    private ExternalTerminal terminal(int columns, int rows) throws IOException {
        ExternalTerminal terminal =
                new ExternalTerminal("test", "xterm-256color", new ByteArrayInputStream(new byte[0]), written, UTF_8);
        terminal.setSize(new Size(columns, rows));
        return terminal;
    }

    private static List<String> padded(List<String> lines, int rows) {
        return Stream.concat(lines.stream(), Stream.generate(() -> ""))
                .limit(rows)
                .toList();
    }

    /** What was written since the last time. */
    private String taken() {
        String text = written.toString(UTF_8);
        written.reset();
        return text;
    }
}
