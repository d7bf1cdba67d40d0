package io.furrow.cli.control;

import java.io.IOException;

/** Reads keys of a terminal in raw mode: a character, or {@code left}, {@code shift-left}, {@code enter} and so on. */
final class KeyReader {
    private static final int ESCAPE = 27;
    private static final int NOTHING = -2;
    private static final long SEQUENCE_MILLIS = 30;

    private final Source source;

    /** A source of characters. */
    interface Source {
        /** @return −1 at the end, −2 after the timeout */
        int read(long timeoutMillis) throws IOException;
    }

    KeyReader(Source source) {
        this.source = source;
    }

    /** @return empty after the timeout; {@code end} at the end of input */
    String read(long timeoutMillis) throws IOException {
        int character = source.read(timeoutMillis);
        return switch (character) {
            case NOTHING -> "";
            case -1 -> "end";
            case ESCAPE -> sequence();
            case '\r', '\n' -> "enter";
            case 8, 127 -> "backspace";
            case 3 -> "q"; // Ctrl-C
            default -> Character.toString(character);
        };
    }

    /** Arrows come as {@code ESC [ C}, {@code ESC O C}, with shift as {@code ESC [ 1 ; 2 C}. */
    private String sequence() throws IOException {
        int next = source.read(SEQUENCE_MILLIS);
        if (next != '[' && next != 'O') {
            return "escape";
        }
        StringBuilder parameters = new StringBuilder();
        int last = source.read(SEQUENCE_MILLIS);
        while (last >= '0' && last <= ';') {
            parameters.append((char) last);
            last = source.read(SEQUENCE_MILLIS);
        }
        String shift = parameters.toString().endsWith(";2") ? "shift-" : "";
        return switch (last) {
            case 'C' -> shift + "right";
            case 'D' -> shift + "left";
            default -> "";
        };
    }
}
