package io.furrow.flink.job;

import java.time.Duration;
import java.util.Map;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.TypeConversionException;

/**
 * Converts durations: whole numbers with one of {@code ms}, {@code s}, {@code m} or {@code min}, {@code h}, {@code d},
 * as {@code 90s} and {@code 1h30m}; and those of ISO 8601, as {@code PT1H30M}.
 */
public final class DurationConverter implements ITypeConverter<Duration> {
    private static final Pattern PART = Pattern.compile("(\\d{1,9})\\s*(ms|s|min|m|h|d)\\s*");
    private static final Pattern ISO =
            Pattern.compile("P(?=.)(\\d{1,6}D)?(T(?=.)(\\d{1,9}H)?(\\d{1,9}M)?(\\d{1,9}([.]\\d{1,9})?S)?)?");
    private static final Map<String, Duration> UNITS = Map.of(
            "ms", Duration.ofMillis(1),
            "s", Duration.ofSeconds(1),
            "m", Duration.ofMinutes(1),
            "min", Duration.ofMinutes(1),
            "h", Duration.ofHours(1),
            "d", Duration.ofDays(1));

    @Override
    public Duration convert(String text) {
        if (ISO.matcher(text).matches()) {
            return Duration.parse(text);
        }
        Duration sum = Duration.ZERO;
        Matcher part = PART.matcher(text.trim());
        while (part.lookingAt()) {
            sum = sum.plus(UNITS.get(part.group(2)).multipliedBy(Long.parseLong(part.group(1))));
            part.region(part.end(), part.regionEnd());
        }
        if (text.isBlank() || part.regionStart() < part.regionEnd()) {
            throw new TypeConversionException(
                    "'" + text + "' is not a duration; write for instance 500ms, 10s, 5min, 1h or 1h30m");
        }
        return sum;
    }
}
