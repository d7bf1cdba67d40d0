package io.furrow.model.time;

import java.time.DateTimeException;
import java.time.Instant;
import java.time.LocalDateTime;
import java.time.ZoneOffset;
import java.util.Optional;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * Parses date and time in other common formats of databases and programs than that of {@link IsoTime}: a space instead
 * of the {@code T}, a comma before the fraction, ISO 8601 in basic format, no seconds, no time of day, {@code UTC} or
 * an offset in hours.
 */
final class OtherTimes {
    private static final Pattern TIME = Pattern.compile("(\\d{4})(-?)(\\d\\d)\\2(\\d\\d)"
            + "(?:[Tt _]\\s*(\\d\\d)(:?)(\\d\\d)(?:\\6(\\d\\d)(?:[.,](\\d{1,9})\\d*)?)?)?"
            + "\\s*(?:[Zz]|UTC|GMT|([+-]\\d\\d(?::?\\d\\d)?))?");

    /** The end of a day, as ISO 8601 allows it. */
    private static final Pattern END_OF_DAY = Pattern.compile("[Tt _]\\s*24(:?00)?(:?00)?(?!\\d|:|[.,]\\d*[1-9])");

    static final int DATE = "yyyyMMdd".length();
    static final int COMPACT = "yyyyMMddHHmmss".length();
    private static final int NANO_DIGITS = 9;
    private static final int SECOND = 8;
    private static final int FRACTION = 9;
    private static final int OFFSET = 10;

    private OtherTimes() {}

    /** Returns the instant, in UTC without an offset; empty if the text is invalid. */
    static Optional<Instant> parse(String text) {
        boolean isCompact = text.length() == COMPACT && text.indexOf('-') < 0 && text.indexOf('T') < 0;
        Matcher time = TIME.matcher(isCompact ? text.substring(0, DATE) + "T" + text.substring(DATE) : text);
        if (!time.matches()) {
            return Optional.empty();
        }
        try {
            boolean isEndOfDay = END_OF_DAY.matcher(time.group()).find();
            LocalDateTime local = LocalDateTime.of(
                    number(time.group(1)),
                    number(time.group(3)),
                    number(time.group(4)),
                    isEndOfDay ? 0 : number(time.group(5)),
                    number(time.group(7)),
                    number(time.group(SECOND)),
                    nanos(time.group(FRACTION)));
            String offset = time.group(OFFSET);
            return Optional.of(local.plusDays(isEndOfDay ? 1 : 0)
                    .toInstant(offset == null ? ZoneOffset.UTC : ZoneOffset.of(offset)));
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }

    private static int number(String digits) {
        return digits == null ? 0 : Integer.parseInt(digits);
    }

    private static int nanos(String digits) {
        return digits == null ? 0 : number(digits + "0".repeat(NANO_DIGITS - digits.length()));
    }
}
