package io.furrow.fields;

import java.util.Locale;

/** Formats parts of notes and reasons. */
final class Phrases {
    private static final int MAX_LENGTH = 60;

    private Phrases() {}

    static String shortened(Object value) {
        String text = String.valueOf(value);
        return text.length() <= MAX_LENGTH ? text : text.substring(0, MAX_LENGTH) + "…";
    }

    /** Formats a position for a human reader. */
    static String place(double longitude, double latitude) {
        return String.format(Locale.ROOT, "longitude %.6f, latitude %.6f", longitude, latitude);
    }
}
