package io.furrow.model.text;

/** Sanitizes external text for a log, in which each line has one author. */
public final class LogText {
    private static final int MAX_LENGTH = 1000;

    private LogText() {}

    /** The beginning of the text on one line. */
    public static String beginning(String text) {
        return oneLine(text.length() > MAX_LENGTH ? text.substring(0, MAX_LENGTH) + "…" : text);
    }

    /** The text with each control character, and each line break, as {@code \} and four digits, as in JSON. */
    public static String oneLine(String text) {
        StringBuilder line = null;
        for (int i = 0; i < text.length(); i++) {
            char sign = text.charAt(i);
            boolean breaks = Character.isISOControl(sign) || sign == 0x2028 || sign == 0x2029;
            if (breaks && line == null) {
                line = new StringBuilder(text.length() + 16).append(text, 0, i);
            }
            if (line != null) {
                line.append(breaks ? String.format("\\u%04x", (int) sign) : sign);
            }
        }
        return line == null ? text : line.toString();
    }
}
