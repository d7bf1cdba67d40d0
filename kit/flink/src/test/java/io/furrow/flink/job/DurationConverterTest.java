package io.furrow.flink.job;

import java.time.Duration;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine.TypeConversionException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DurationConverterTest {
    private final DurationConverter converter = new DurationConverter();

    @ParameterizedTest
    @CsvSource({
        "500ms, PT0.5S",
        "10s, PT10S",
        "5min, PT5M",
        "1h, PT1H",
        "2d, PT48H",
        "0s, PT0S",
        "' 10 s ', PT10S",
        "999999999d, PT23999999976H",
        "10m, PT10M",
        "1h30min, PT1H30M",
        "'1d 2h 3m', PT26H3M",
        "1m500ms, PT1M0.5S",
        "PT10S, PT10S",
        "PT1H30M, PT1H30M",
        "P1DT0.5S, PT24H0.5S"
    })
    void readsWholeNumbersAndTheirUnits(String text, Duration expected) {
        assertThat(converter.convert(text)).isEqualTo(expected);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "",
                "10",
                "s",
                "-1s",
                "1.5s",
                "10S",
                "9999999999s",
                "1h30",
                "1hm",
                "-PT10S",
                "PT",
                "P",
                "PT-1S",
                "1 h, 3 m"
            })
    void saysHowToWriteADurationWhereItCannotReadOne(String text) {
        assertThatThrownBy(() -> converter.convert(text))
                .isInstanceOf(TypeConversionException.class)
                .hasMessage("'" + text + "' is not a duration; write for instance 500ms, 10s, 5min, 1h or 1h30m");
    }
}
