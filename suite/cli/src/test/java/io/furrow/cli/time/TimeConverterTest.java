package io.furrow.cli.time;

import java.time.Instant;
import java.time.ZonedDateTime;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine.TypeConversionException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TimeConverterTest {
    private static final ZonedDateTime NOW = ZonedDateTime.parse("2026-05-01T12:00:00+02:00[Europe/Madrid]");

    @ParameterizedTest
    @CsvSource({
        "2026-05-01T08:00:00+01:00, 2026-05-01T07:00:00Z",
        "2026-05-01T08:00:00.5Z, 2026-05-01T08:00:00.5Z",
        "2026-05-01T08:00, 2026-05-01T06:00:00Z",
        "2026-12-01T08:00:07, 2026-12-01T07:00:07Z",
        "2026-05-01, 2026-04-30T22:00:00Z",
        "now, 2026-05-01T10:00:00Z",
        "-5m, 2026-05-01T09:55:00Z",
        "-1h30m, 2026-05-01T08:30:00Z",
        "+2h, 2026-05-01T12:00:00Z",
        "06:00, 2026-05-01T04:00:00Z",
        "12:00, 2026-05-01T10:00:00Z",
        "12:00:01, 2026-04-30T10:00:01Z",
        "1777600000000, 2026-05-01T01:46:40Z",
        "7, 1970-01-01T00:00:00.007Z"
    })
    void readsTimesAsPeopleWriteThem(String text, Instant time) {
        assertThat(new TimeConverter().convert(text, NOW)).isEqualTo(time);
    }

    @ParameterizedTest
    @CsvSource({
        "06:00, 2026-05-02T04:00:00Z", "12:00, 2026-05-01T10:00:00Z",
        "12:00:01, 2026-05-01T10:00:01Z", "-5m, 2026-05-01T09:55:00Z"
    })
    void readsTheNextOneOfATimeOfDay(String text, Instant time) {
        assertThat(new TimeConverter.Next().convert(text, NOW)).isEqualTo(time);
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "soon", "-5", "5m", "2026-02-30", "25:00", "2026-05-01 08:00", "1e12", "-"})
    void saysHowToWriteATimeWhereItCannotReadOne(String text) {
        assertThatThrownBy(() -> new TimeConverter().convert(text, NOW))
                .isInstanceOf(TypeConversionException.class)
                .hasMessage("'%s' is not a time; write for instance 2026-05-01T08:00:00, 06:00, -5m or now", text);
    }
}
