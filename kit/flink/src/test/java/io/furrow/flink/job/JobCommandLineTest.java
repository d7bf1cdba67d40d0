package io.furrow.flink.job;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class JobCommandLineTest {
    @ParameterizedTest
    @CsvSource(nullValues = "-", textBlock = """
            -,   100
            80,  80
            40,  60
            300, 120
            0,   100
            x,   100
            """)
    void printsHelpAsWideAsTheTerminalWithinReason(String terminal, int columns) {
        assertThat(JobCommandLine.columns(terminal)).isEqualTo(columns);
    }
}
