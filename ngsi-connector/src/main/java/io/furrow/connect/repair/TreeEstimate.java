package io.furrow.connect.repair;

/** Estimates the heap that a JSON document needs as a tree. */
final class TreeEstimate {
    /** An object with its map, a list with its array, the entry of a member with its name, an element. */
    private static final int OBJECT = 160;

    private static final int LIST = 104;
    private static final int MEMBER = 100;
    private static final int ELEMENT = 24;

    private TreeEstimate() {}

    /** Bytes, rather too many than too few; any number for invalid JSON. */
    static long of(byte[] json) {
        long bytes = 2L * json.length;
        boolean inText = false;
        for (int i = 0; i < json.length; i++) {
            byte sign = json[i];
            if (inText) {
                if (sign == '\\') {
                    i++;
                } else if (sign == '"') {
                    inText = false;
                }
            } else {
                switch (sign) {
                    case '"' -> inText = true;
                    case '{' -> bytes += OBJECT;
                    case '[' -> bytes += LIST;
                    case ':' -> bytes += MEMBER;
                    case ',' -> bytes += ELEMENT;
                    default -> {
                        // part of a number, a literal or white space
                    }
                }
            }
        }
        return bytes;
    }
}
