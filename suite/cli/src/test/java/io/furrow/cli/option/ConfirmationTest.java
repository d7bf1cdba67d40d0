package io.furrow.cli.option;

import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ConfirmationTest {
    private final List<String> asked = new ArrayList<>();

    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "end", textBlock = """
            y     | true
            ' YES'| true
            n     | false
            ''    | false
            yep   | false
            end   | false
            """)
    void doesItWhereTheAnswerIsYes(String answer, boolean done) {
        Confirmation confirmation = confirmation(answer);

        if (done) {
            confirmation.ask("Delete mission m?");
        } else {
            assertThatThrownBy(() -> confirmation.ask("Delete mission m?"))
                    .isInstanceOf(CommandException.class)
                    .hasMessage("Nothing was done.");
        }
        assertThat(asked).containsExactly("Delete mission m? [y/N] ");
    }

    @Test
    void asksNothingWithTheOptionOrWithoutATerminal() {
        Confirmation confirmed = confirmation("n");
        new CommandLine(confirmed).parseArgs("-y");

        confirmed.ask("Delete mission m?");
        new Confirmation(null).ask("Delete mission m?");

        assertThat(asked).isEmpty();
    }

    @Test
    void namesAFewThings() {
        assertThat(Confirmation.named("mission", List.of("a"))).isEqualTo("mission a");
        assertThat(Confirmation.named("mission", List.of("a", "b"))).isEqualTo("2 missions (a, b)");
        assertThat(Confirmation.named("mission", List.of("a", "b", "c", "d", "e", "f")))
                .isEqualTo("6 missions (a, b, c, d, e, …)");
    }

    private Confirmation confirmation(String answer) {
        return new Confirmation(question -> {
            asked.add(question);
            return answer;
        });
    }
}
