package io.furrow.cli.option;

import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class OutputOptionsTest {
    @Test
    void cutsLinesToTheWidthOfTheTerminal() {
        assertThat(OutputOptions.cut(List.of("123456", "12345", ""), 5)).containsExactly("1234…", "12345", "");
    }
}
