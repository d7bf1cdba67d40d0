package io.furrow.model.text;

/**
 * Validates UTF-8 (RFC 3629), because Jackson's decoder accepts overlong forms and code points beyond U+10FFFF, and
 * makes texts encodable.
 */
public final class Utf8 {
    private Utf8() {}

    /** Replaces halves of surrogate pairs, which UTF-8 cannot encode, by U+FFFD. */
    public static String encodable(String text) {
        return text.codePoints()
                .map(each -> Character.getType(each) == Character.SURROGATE ? 0xfffd : each)
                .collect(StringBuilder::new, StringBuilder::appendCodePoint, StringBuilder::append)
                .toString();
    }

    /** Returns the position of the first byte that is not part of a UTF-8 sequence; -1 if there is none. */
    public static int firstWrong(byte[] bytes) {
        int i = 0;
        while (i < bytes.length) {
            if (bytes[i] >= 0) {
                i++;
                continue;
            }
            int length = length(bytes, i);
            if (length == 0) {
                return i;
            }
            i += length;
        }
        return -1;
    }

    /** Returns the length of the multi-byte sequence that begins here; 0 if none does. */
    private static int length(byte[] bytes, int at) {
        int first = bytes[at] & 0xff;
        int second = at + 1 < bytes.length ? bytes[at + 1] & 0xff : 0;
        int length = first >= 0xc2 && first <= 0xdf
                ? 2
                : first >= 0xe0 && first <= 0xef ? 3 : first >= 0xf0 && first <= 0xf4 ? 4 : 0;
        int minSecond = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
        int maxSecond = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
        if (length == 0 || at + length > bytes.length || second < minSecond || second > maxSecond) {
            return 0;
        }
        for (int i = at + 2; i < at + length; i++) {
            if ((bytes[i] & 0xc0) != 0x80) {
                return 0;
            }
        }
        return length;
    }
}
