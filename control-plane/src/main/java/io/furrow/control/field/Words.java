package io.furrow.control.field;

import java.util.Locale;

/** Phrases of notes and refusals. */
final class Words {
    private static final int LONGEST = 60;

    private Words() {}

    /** For instance {@code 1 ring}, {@code 2 rings}. */
    static String count(int count, String thing) {
        return count + " " + thing + (count == 1 ? "" : "s");
    }

    static String shortened(Object value) {
        String text = String.valueOf(value);
        return text.length() <= LONGEST ? text : text.substring(0, LONGEST) + "…";
    }

    /** A position as people find it on a map. */
    static String place(double longitude, double latitude) {
        return String.format(Locale.ROOT, "longitude %.6f, latitude %.6f", longitude, latitude);
    }
}
