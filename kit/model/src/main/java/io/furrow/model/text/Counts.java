package io.furrow.model.text;

import java.util.Locale;

/** Formats counts of things for messages. */
public final class Counts {
    private Counts() {}

    /** Returns for instance {@code 1 device}, {@code 2,000 devices}. */
    public static String of(long count, String thing) {
        return String.format(Locale.ROOT, "%,d %s", count, things(count, thing));
    }

    /** Returns for instance {@code 1 device is}, {@code 2 devices are}. */
    public static String are(long count, String thing) {
        return of(count, thing) + (count == 1 ? " is" : " are");
    }

    /**
     * Returns for instance {@code 1 of 1 device is}, {@code 2 of 3 devices of mission m are}.
     *
     * @param whose follows the things
     */
    public static String areOf(long some, long total, String thing, String whose) {
        return "%d of %d %s%s %s".formatted(some, total, things(total, thing), whose, some == 1 ? "is" : "are");
    }

    /** Returns {@code once}, {@code 2 times}. */
    public static String times(long count) {
        return count == 1 ? "once" : of(count, "time");
    }

    private static String things(long count, String thing) {
        return count == 1 ? thing : thing + "s";
    }
}
