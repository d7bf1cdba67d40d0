package io.furrow.model.topic;

import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.HexFormat;

/**
 * The part of a topic's name that a domain or mission becomes. Names of 1 to 64 of {@code A-Z a-z 0-9 _ -} stand as they
 * are. Every other name is encoded so that no two names ever share a topic:
 *
 * <ul>
 *   <li>{@code _x-} followed by the name's UTF-8 bytes, letters and digits as they are, any other byte as {@code -HH} (two
 *       upper-case hexadecimal digits): {@code field.7} → {@code _x-field-2E7};
 *   <li>{@code _h-} followed by the SHA-256 of the name in hexadecimal where that would exceed 100 signs.
 * </ul>
 *
 * <p>Names that begin like an encoding are encoded themselves. So are names that hold {@code _realtime}: a broker refuses a
 * topic that differs from another only in {@code .} and {@code _} ({@code data.a_realtime_b.realtime} and {@code
 * data.a.realtime.b_realtime}). And so are {@code dead} and names that end in {@code _dead}: {@code data.a.realtime.dead}
 * takes the dead letters of {@code data.a.realtime}.
 */
public final class TopicName {
    private static final int LONGEST_PLAIN = 64;
    private static final int LONGEST = 100;

    private TopicName() {}

    /** Whether a manager would accept the name for a domain or mission. */
    public static boolean isLegal(String name) {
        boolean legal = !name.isEmpty() && name.length() <= LONGEST_PLAIN;
        for (int i = 0; legal && i < name.length(); i++) {
            char sign = name.charAt(i);
            legal = isAlphanumeric(sign) || sign == '_' || sign == '-';
        }
        return legal;
    }

    private static boolean isAlphanumeric(int sign) {
        return sign >= '0' && sign <= '9' || sign >= 'A' && sign <= 'Z' || sign >= 'a' && sign <= 'z';
    }

    public static String of(String name) {
        boolean encodingLike = name.startsWith("_x-") || name.startsWith("_h-");
        boolean topicLike = name.contains("_realtime") || name.equals("dead") || name.endsWith("_dead");
        return isLegal(name) && !encodingLike && !topicLike ? name : encoded(name);
    }

    private static String encoded(String name) {
        StringBuilder encoded = new StringBuilder("_x-");
        for (byte b : name.getBytes(StandardCharsets.UTF_8)) {
            encoded.append(isAlphanumeric(b) ? String.valueOf((char) b) : String.format("-%02X", b));
        }
        return encoded.length() <= LONGEST ? encoded.toString() : "_h-" + sha256(name);
    }

    private static String sha256(String name) {
        try {
            byte[] digest = MessageDigest.getInstance("SHA-256").digest(name.getBytes(StandardCharsets.UTF_8));
            return HexFormat.of().formatHex(digest);
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-256", e);
        }
    }
}
