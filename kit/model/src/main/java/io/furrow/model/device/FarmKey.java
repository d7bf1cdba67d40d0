package io.furrow.model.device;

import java.nio.charset.StandardCharsets;
import java.security.GeneralSecurityException;
import java.time.Instant;
import java.util.Base64;
import java.util.HexFormat;
import javax.crypto.Mac;
import javax.crypto.spec.SecretKeySpec;

/**
 * A key of a farm's secret, from which codes are derived (HMAC-SHA-256).
 *
 * @param number from 1; the newest key has the highest
 * @param text the key itself, at least 16 bytes in UTF-8; omitted from {@link #toString()}
 * @param until when its passwords expire; null for the newest key
 */
record FarmKey(int number, String text, Instant until) {
    static final int MIN_BYTES = 16;

    private static final String MAC = "HmacSHA256";
    private static final int CODE_CHARACTERS = 22;
    private static final int FINGERPRINT_BYTES = 8;

    /** @throws IllegalArgumentException if the text is too short */
    FarmKey {
        int bytes = text.getBytes(StandardCharsets.UTF_8).length;
        if (bytes < MIN_BYTES) {
            throw new IllegalArgumentException(
                    "a farm's secret has at least %d bytes, this one %d; make one with: ./furrow secret new FILE"
                            .formatted(MIN_BYTES, bytes));
        }
    }

    FarmKey endingAt(Instant end) {
        return new FarmKey(number, text, end);
    }

    boolean isAcceptedAt(Instant time) {
        return until == null || until.isAfter(time);
    }

    /** Returns a code of 22 characters of {@code A-Za-z0-9_-}, about 130 bits. */
    String code(String... parts) {
        byte[] code = mac(String.join("\n", parts));
        return Base64.getUrlEncoder().withoutPadding().encodeToString(code).substring(0, CODE_CHARACTERS);
    }

    /** Returns a deterministic fingerprint of 16 hexadecimal digits; the key cannot be derived from it. */
    String fingerprint() {
        return HexFormat.of().formatHex(mac("fingerprint"), 0, FINGERPRINT_BYTES);
    }

    private byte[] mac(String message) {
        try {
            Mac mac = Mac.getInstance(MAC);
            mac.init(new SecretKeySpec(text.getBytes(StandardCharsets.UTF_8), MAC));
            return mac.doFinal(message.getBytes(StandardCharsets.UTF_8));
        } catch (GeneralSecurityException e) {
            throw new IllegalStateException("every JDK has " + MAC, e);
        }
    }

    @Override
    public String toString() {
        return "key " + number + (until == null ? "" : " until " + until);
    }
}
