package io.furrow.ingest.image;

import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.Arrays;
import java.util.Base64;
import java.util.Locale;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Decodes the text of an image attribute: base64 (RFC 4648) in the standard or the URL-safe alphabet, with or without
 * padding, with line breaks, with {@code %3D} and the like for characters that the context broker forbids, or a data URI (RFC
 * 2397).
 */
final class ImageDecoder {
    private static final byte FOREIGN = -1;
    private static final byte BLANK = -2;
    private static final byte[] PLAIN = plain();

    private ImageDecoder() {}

    /** @param text ASCII or UTF-8; not modified */
    static byte[] decode(byte[] text) throws UnreadableException {
        try {
            return decodePlain(text);
        } catch (IllegalArgumentException e) { // a character outside the alphabet: another variant, or invalid
            return decodeAnyForm(text);
        }
    }

    /** The common case, several times faster than character by character: one line, padded with {@code =} or {@code %3D}. */
    private static byte[] decodePlain(byte[] text) {
        int length = text.length;
        for (int padding = 0; padding < 2 && length >= 3 && isEscapedPadding(text, length - 3); padding++) {
            length -= 3;
        }
        ByteBuffer decoded = Base64.getDecoder().decode(ByteBuffer.wrap(text, 0, length));
        return decoded.remaining() == decoded.array().length
                ? decoded.array()
                : Arrays.copyOf(decoded.array(), decoded.remaining());
    }

    private static boolean isEscapedPadding(byte[] text, int at) {
        return text[at] == '%' && text[at + 1] == '3' && (text[at + 2] == 'D' || text[at + 2] == 'd');
    }

    private static byte[] decodeAnyForm(byte[] text) throws UnreadableException {
        byte[] base64 = isDataUri(text) ? behindTheComma(percentDecoded(text)) : text;
        byte[] plain = new byte[base64.length];
        int length = 0;
        for (int i = 0; i < base64.length; i++) {
            int sign = base64[i];
            if (sign == '%') {
                sign = escaped(base64, i);
                i += 2;
            }
            byte kept = sign < 0 ? FOREIGN : PLAIN[sign];
            if (kept == FOREIGN) {
                throw new UnreadableException(
                        Reason.NOT_AN_IMAGE, "the image is not base64: sign " + i + " is " + name(sign));
            }
            if (kept != BLANK) {
                plain[length++] = kept;
            }
        }
        try {
            return Base64.getDecoder().decode(length == plain.length ? plain : Arrays.copyOf(plain, length));
        } catch (IllegalArgumentException e) {
            throw new UnreadableException(Reason.NOT_AN_IMAGE, "the image is not base64: " + e.getMessage(), e);
        }
    }

    private static boolean isDataUri(byte[] text) {
        String start = new String(text, 0, Math.min(text.length, "data%3A".length()), StandardCharsets.ISO_8859_1)
                .toLowerCase(Locale.ROOT);
        return start.startsWith("data:") || start.startsWith("data%3a");
    }

    private static byte[] behindTheComma(byte[] uri) throws UnreadableException {
        int comma = 0;
        while (comma < uri.length && uri[comma] != ',') {
            comma++;
        }
        String head = new String(uri, 0, comma, StandardCharsets.ISO_8859_1).toLowerCase(Locale.ROOT);
        if (comma == uri.length || !head.endsWith(";base64")) {
            throw new UnreadableException(Reason.NOT_AN_IMAGE, "the image is a data URI that is not base64");
        }
        return Arrays.copyOfRange(uri, comma + 1, uri.length);
    }

    private static byte[] percentDecoded(byte[] text) throws UnreadableException {
        byte[] decoded = new byte[text.length];
        int length = 0;
        for (int i = 0; i < text.length; i++) {
            if (text[i] == '%') {
                decoded[length++] = (byte) escaped(text, i);
                i += 2;
            } else {
                decoded[length++] = text[i];
            }
        }
        return Arrays.copyOf(decoded, length);
    }

    /** The byte that {@code %HH} at a position encodes. */
    private static int escaped(byte[] text, int at) throws UnreadableException {
        int high = at + 2 < text.length ? Character.digit(text[at + 1], 16) : -1;
        int low = at + 2 < text.length ? Character.digit(text[at + 2], 16) : -1;
        if (high < 0 || low < 0) {
            throw new UnreadableException(
                    Reason.NOT_AN_IMAGE, "the image is not base64: % at sign " + at + " is not an escape");
        }
        return (byte) (high << 4 | low);
    }

    private static String name(int sign) {
        return sign > ' ' && sign < 0x7f ? "'" + (char) sign + "'" : String.format("0x%02X", sign & 0xff);
    }

    private static byte[] plain() {
        byte[] plain = new byte[128];
        Arrays.fill(plain, FOREIGN);
        for (char sign = 'A'; sign <= 'Z'; sign++) {
            plain[sign] = (byte) sign;
            plain[Character.toLowerCase(sign)] = (byte) Character.toLowerCase(sign);
        }
        for (char sign : "0123456789+/=".toCharArray()) {
            plain[sign] = (byte) sign;
        }
        plain['-'] = '+';
        plain['_'] = '/';
        for (char blank : " \t\r\n\f".toCharArray()) {
            plain[blank] = BLANK;
        }
        return plain;
    }
}
