package io.furrow.model.time;

import java.time.Instant;
import java.time.OffsetDateTime;
import java.time.ZoneOffset;
import java.util.Optional;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.fail;

/** Compares with the formatter of the JDK, which reads the same format and more. */
class IsoTimeTest {
    private static final long FIRST = Instant.parse("0000-01-02T00:00:00Z").getEpochSecond();
    private static final long LAST = Instant.parse("9999-12-30T23:59:59Z").getEpochSecond();
    private static final String SIGNS = "0123456789-:TZ.+/ tz";

    private final Random random = new Random(20261121);

    @Test
    void readsDaysOfEveryYearAsTheFormatterDoes() {
        for (long day = FIRST / 86_400; day < LAST / 86_400; day += 3) {
            Instant instant = Instant.ofEpochSecond(86_400 * day + day % 86_400);
            if (!IsoTime.parse(instant.toString()).equals(Optional.of(instant))) {
                fail("%s is read as %s", instant, IsoTime.parse(instant.toString()));
            }
        }
    }

    @Test
    void readsFractionsAndOffsetsAsTheFormatterDoes() {
        for (int i = 0; i < 30_000; i++) {
            String text = time();
            agree(text);
            assertThat(IsoTime.parse(text)).isPresent();
        }
    }

    @Test
    void neverReadsATimeOtherThanTheFormatter() {
        int read = 0;
        for (int i = 0; i < 30_000; i++) {
            StringBuilder broken = new StringBuilder(time());
            for (int changes = 1 + random.nextInt(2); changes > 0; changes--) {
                int at = random.nextInt(broken.length());
                char character = SIGNS.charAt(random.nextInt(SIGNS.length()));
                switch (random.nextInt(4)) {
                    case 0 -> broken.deleteCharAt(at);
                    case 1 -> broken.insert(at, character);
                    default -> broken.setCharAt(at, character);
                }
            }
            String text = broken.toString();
            if (IsoTime.parse(text).isPresent()) {
                agree(text);
                read++;
            }
        }
        assertThat(read).isGreaterThan(2_000);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "", "2026", "2026-02-30T00:00:00Z",
                "2025-02-29T00:00:00Z", "1900-02-29T00:00:00Z", "2026-00-10T00:00:00Z",
                "2026-13-10T00:00:00Z", "2026-01-00T00:00:00Z", "2026-01-01T24:00:00Z",
                "2026-01-01T00:60:00Z", "2026-01-01T00:00:60Z", "2026-01-01T00:00:00+18:01",
                "2026-01-01T00:00:00.Z", "2026-01-01 00:00:00Z", "2026-01-01T00:00:00.1234567890Z",
                "2026-01-01T00:00:00+1:00", "2026-01-01T00:00:00ZZ", "-2026-01-01T00:00:00Z",
                "+02026-01-01T00:00:00Z"
            })
    void rejectsOtherFormats(String text) {
        assertThat(IsoTime.parse(text)).isEmpty();
    }

    private static void agree(String text) {
        if (!IsoTime.parse(text).equals(Instants.anyForm(text))) {
            fail("%s is read as %s, not as %s", text, IsoTime.parse(text), Instants.anyForm(text));
        }
    }

    private String time() {
        long second = FIRST + (long) ((LAST - FIRST) * random.nextDouble());
        Instant instant = Instant.ofEpochSecond(random.nextBoolean() ? second : 1_700_000_000 + random.nextInt());
        String local =
                OffsetDateTime.ofInstant(instant, ZoneOffset.UTC).toString().substring(0, 16);
        String fraction =
                "." + String.format("%09d", random.nextInt(1_000_000_000)).substring(0, 1 + random.nextInt(9));
        int hours = random.nextInt(19);
        String offset = String.format(
                "%s%02d:%02d", random.nextBoolean() ? "+" : "-", hours, hours == 18 ? 0 : random.nextInt(60));
        return local
                + String.format(":%02d", random.nextInt(60))
                + (random.nextBoolean() ? fraction : "")
                + new String[] {"", "Z", offset}[random.nextInt(3)];
    }
}
