package io.furrow.control.manager;

import io.furrow.model.control.Limits;

/** Thrown if a record would be larger than {@link Limits#RECORD_BYTES}; nothing was written. */
final class OversizedRecordException extends RuntimeException {
    private static final long serialVersionUID = 1L;
    private static final int MAX_QUOTE_LENGTH = 80;

    OversizedRecordException(String target, String key, long bytes) {
        super("the record of '%s' on %s would have %d bytes; at most %d are written"
                .formatted(abbreviated(key), target, bytes, Limits.RECORD_BYTES));
    }

    /** @param target topic or store that the record is for */
    static void check(String target, String key, byte[] value) {
        if (size(key, value) > Limits.RECORD_BYTES) {
            throw new OversizedRecordException(target, key, size(key, value));
        }
    }

    private static String abbreviated(String key) {
        return key == null || key.length() <= MAX_QUOTE_LENGTH ? key : key.substring(0, MAX_QUOTE_LENGTH) + "...";
    }

    /** Returns an upper bound of the bytes of key and value, with three bytes per character of the key. */
    static long size(String key, byte[] value) {
        return (value == null ? 0 : value.length) + (key == null ? 0 : 3L * key.length());
    }
}
