package io.furrow.cli.time;

import java.time.Instant;
import java.time.ZoneId;

import com.fasterxml.jackson.databind.node.TextNode;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

/** The tests run in UTC. */
class TimesTest {
    @ParameterizedTest
    @CsvSource({
        "2026-05-01T06:00:00.999Z, Europe/Madrid,   2026-05-01T08:00:00+02:00",
        "2026-11-28T06:00:07Z,     Europe/Madrid,   2026-11-28T07:00:07+01:00",
        "2026-05-01T06:00:00Z,     America/Caracas, 2026-05-01T02:00:00-04:00",
        "2026-05-01T06:00:00Z,     UTC,             2026-05-01T06:00:00Z"
    })
    void writesTimesOfTheZoneWithTheirOffset(Instant time, ZoneId zone, String written) {
        assertThat(Times.of(time, zone)).isEqualTo(written);
    }

    @ParameterizedTest
    @CsvSource(nullValues = "-", textBlock = """
            2026-05-01T06:00:00.5Z,    2026-05-01T06:00:00Z
            2026-05-01T06:00:00+02:00, 2026-05-01T04:00:00Z
            soon,                      soon
            '',                        ''
            """)
    void leavesATextThatIsNoTime(String text, String written) {
        assertThat(Times.of(TextNode.valueOf(text))).isEqualTo(written);
    }

    @ParameterizedTest
    @CsvSource({
        "2026-05-01T05:58:00Z, 2026-05-01T05:58:00Z (2m ago)",
        "2026-05-01T08:00:30Z, 2026-05-01T08:00:30Z (in 2h)"
    })
    void writesTheDistanceFromNow(Instant time, String written) {
        assertThat(Times.ago(time.toEpochMilli(), Instant.parse("2026-05-01T06:00:00Z")))
                .isEqualTo(written);
    }
}
