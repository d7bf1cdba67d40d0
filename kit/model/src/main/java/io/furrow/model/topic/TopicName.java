package io.furrow.model.topic;

import java.io.ByteArrayOutputStream;
import java.nio.charset.StandardCharsets;
import java.util.Optional;

import io.furrow.model.text.Sha256;

/**
 * Encodes domains and missions as parts of topic names. Names of 1 to 64 of {@code A-Z a-z 0-9 _ -} stay unchanged.
 * Every other name is encoded so that no two names share a topic:
 *
 * <ul>
 *   <li>{@code _x-} followed by the name's UTF-8 bytes, letters and digits as they are, any other byte as {@code -HH}
 *       (two upper-case hexadecimal digits): {@code field.7} → {@code _x-field-2E7};
 *   <li>{@code _h-} followed by the SHA-256 of the name in hexadecimal if that would exceed 100 characters.
 * </ul>
 *
 * <p>Names that begin like an encoding are encoded, too. So are names with {@code _realtime}: a broker rejects a topic
 * that differs from another only in {@code .} and {@code _} ({@code data.a_realtime_b.realtime} and {@code
 * data.a.realtime.b_realtime}). So are {@code dead} and names that end in {@code _dead}: {@code data.a.realtime.dead}
 * is the topic of the dead letters of {@code data.a.realtime}.
 */
public final class TopicName {
    private static final int MAX_PLAIN_LENGTH = 64;
    private static final int MAX_LENGTH = 100;

    private TopicName() {}

    /** Returns whether managers accept the name for a domain or mission. */
    public static boolean isLegal(String name) {
        boolean legal = !name.isEmpty() && name.length() <= MAX_PLAIN_LENGTH;
        for (int i = 0; legal && i < name.length(); i++) {
            char character = name.charAt(i);
            legal = isAlphanumeric(character) || character == '_' || character == '-';
        }
        return legal;
    }

    private static boolean isAlphanumeric(int character) {
        return character >= '0' && character <= '9'
                || character >= 'A' && character <= 'Z'
                || character >= 'a' && character <= 'z';
    }

    public static String of(String name) {
        boolean encodingLike = name.startsWith("_x-") || name.startsWith("_h-");
        boolean topicLike = name.contains("_realtime") || name.equals("dead") || name.endsWith("_dead");
        return isLegal(name) && !encodingLike && !topicLike ? name : encode(name);
    }

    /** Decodes a part of a topic's name; empty if it is a hash or not an encoding. */
    public static Optional<String> original(String part) {
        String name = part.startsWith("_x-") ? decode(part.substring(3)) : part;
        return of(name).equals(part) ? Optional.of(name) : Optional.empty();
    }

    private static String decode(String encoded) {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        int at = 0;
        while (at < encoded.length()) {
            boolean escaped = encoded.charAt(at) == '-' && at + 3 <= encoded.length();
            int value = escaped ? hexadecimal(encoded.substring(at + 1, at + 3)) : encoded.charAt(at);
            bytes.write(value);
            at += escaped ? 3 : 1;
        }
        return bytes.toString(StandardCharsets.UTF_8);
    }

    /** Parses two hexadecimal digits; 0 if they are invalid, which the check of the whole name detects. */
    private static int hexadecimal(String digits) {
        int high = Character.digit(digits.charAt(0), 16);
        int low = Character.digit(digits.charAt(1), 16);
        return high < 0 || low < 0 ? 0 : high * 16 + low;
    }

    private static String encode(String name) {
        StringBuilder encoded = new StringBuilder("_x-");
        for (byte b : name.getBytes(StandardCharsets.UTF_8)) {
            encoded.append(isAlphanumeric(b) ? String.valueOf((char) b) : String.format("-%02X", b));
        }
        return encoded.length() <= MAX_LENGTH ? encoded.toString() : "_h-" + Sha256.hex(name);
    }
}
