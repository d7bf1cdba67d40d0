package io.furrow.model.time;

import java.time.Instant;
import java.util.Optional;

/**
 * Parses date and time in the most common format, {@code yyyy-MM-ddTHH:mm:ss[.S…][Z|±hh:mm]}, with up to nine digits of
 * a second's fraction; UTC without an offset. It reads digit by digit, which is much faster than a formatter.
 */
final class IsoTime {
    private static final int DATE_AND_TIME = "yyyy-MM-ddTHH:mm:ss".length();
    private static final int OFFSET = "+hh:mm".length();
    private static final int MAX_FRACTION_DIGITS = 9;
    private static final int MAX_OFFSET_MINUTES = 18 * 60;
    private static final int[] DAYS_OF_MONTH = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};

    private IsoTime() {}

    /**
     * Returns the instant; empty if the text has another format, which may still be a time, or an invalid day or hour.
     */
    static Optional<Instant> parse(CharSequence text) {
        int length = text.length();
        if (length < DATE_AND_TIME || !hasMarks(text)) {
            return Optional.empty();
        }
        long seconds = seconds(
                number(text, 0, 4),
                number(text, 5, 7),
                number(text, 8, 10),
                number(text, 11, 13),
                number(text, 14, 16),
                number(text, 17, 19));
        int at = fractionEnd(text);
        int minutesEast = offset(text, at);
        return seconds == Long.MIN_VALUE || at < 0 || minutesEast == Integer.MIN_VALUE
                ? Optional.empty()
                : Optional.of(Instant.ofEpochSecond(seconds - 60L * minutesEast, nanos(text, at)));
    }

    private static boolean hasMarks(CharSequence text) {
        return text.charAt(4) == '-'
                && text.charAt(7) == '-'
                && text.charAt(10) == 'T'
                && text.charAt(13) == ':'
                && text.charAt(16) == ':';
    }

    /** Parses digits; −1 for anything else. */
    private static int number(CharSequence text, int from, int to) {
        int number = 0;
        for (int i = from; i < to; i++) {
            int digit = text.charAt(i) - '0';
            if (digit < 0 || digit > 9) {
                return -1;
            }
            number = 10 * number + digit;
        }
        return number;
    }

    private static long seconds(int... field) {
        int year = field[0];
        int month = field[1];
        int day = field[2];
        boolean exists = year >= 0
                && (month >= 1 && month <= 12)
                && (day >= 1 && day <= daysOf(year, month))
                && (field[3] >= 0 && field[3] <= 23)
                && (field[4] >= 0 && field[4] <= 59)
                && (field[5] >= 0 && field[5] <= 59);
        return exists ? ((epochDay(year, month, day) * 24 + field[3]) * 60 + field[4]) * 60 + field[5] : Long.MIN_VALUE;
    }

    private static int daysOf(int year, int month) {
        boolean leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
        return leap && month == 2 ? 29 : DAYS_OF_MONTH[month - 1];
    }

    /** Days since 1970-01-01 in the proleptic Gregorian calendar, counted in years that begin in March. */
    private static long epochDay(int year, int month, int day) {
        int marchYear = month > 2 ? year : year - 1;
        long era = Math.floorDiv(marchYear, 400);
        long yearOfEra = marchYear - 400 * era;
        long dayOfYear = (153L * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
        return 146_097 * era + 365 * yearOfEra + yearOfEra / 4 - yearOfEra / 100 + dayOfYear - 719_468;
    }

    /** Returns the end of the second's fraction, or its possible beginning; −1 for a fraction of another format. */
    private static int fractionEnd(CharSequence text) {
        if (text.length() == DATE_AND_TIME || text.charAt(DATE_AND_TIME) != '.') {
            return DATE_AND_TIME;
        }
        int at = DATE_AND_TIME + 1;
        while (at < text.length() && number(text, at, at + 1) >= 0) {
            at++;
        }
        int digits = at - DATE_AND_TIME - 1;
        return digits >= 1 && digits <= MAX_FRACTION_DIGITS ? at : -1;
    }

    private static int nanos(CharSequence text, int end) {
        if (end == DATE_AND_TIME) {
            return 0;
        }
        int nanos = number(text, DATE_AND_TIME + 1, end);
        for (int digits = end - DATE_AND_TIME - 1; digits < MAX_FRACTION_DIGITS; digits++) {
            nanos *= 10;
        }
        return nanos;
    }

    /** Returns minutes east of Greenwich; {@link Integer#MIN_VALUE} if the rest is not an offset of this format. */
    private static int offset(CharSequence text, int at) {
        int left = text.length() - at;
        if (at < 0 || left == 0 || left == 1 && text.charAt(at) == 'Z') {
            return 0;
        }
        char sign = text.charAt(at);
        if (left != OFFSET || sign != '+' && sign != '-' || text.charAt(at + 3) != ':') {
            return Integer.MIN_VALUE;
        }
        int hours = number(text, at + 1, at + 3);
        int minutes = number(text, at + 4, at + 6);
        boolean exists = hours >= 0 && minutes >= 0 && minutes <= 59 && 60 * hours + minutes <= MAX_OFFSET_MINUTES;
        return exists ? (sign == '-' ? -1 : 1) * (60 * hours + minutes) : Integer.MIN_VALUE;
    }
}
