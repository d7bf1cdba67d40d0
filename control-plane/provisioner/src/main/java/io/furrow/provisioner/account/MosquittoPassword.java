package io.furrow.provisioner.account;

import java.security.GeneralSecurityException;
import java.security.MessageDigest;
import java.security.SecureRandom;
import java.security.spec.KeySpec;
import java.util.Base64;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import javax.crypto.SecretKeyFactory;
import javax.crypto.spec.PBEKeySpec;

import io.furrow.model.device.FarmSecret;

/**
 * Creates and verifies lines of Mosquitto's password file: {@code user:$7$iterations$salt$hash}, PBKDF2 with
 * HMAC-SHA-512, as mosquitto_passwd does.
 */
public final class MosquittoPassword {
    private static final Pattern LINE = Pattern.compile("([^:]+):\\$7\\$(\\d{1,9})\\$([^$]+)\\$([^$]+)");
    private static final String FUNCTION = "PBKDF2WithHmacSHA512";
    /** The default of Mosquitto 2.0; passwords with about 130 random bits need no more. */
    private static final int ITERATIONS = 101;

    private static final int SALT_BYTES = 12;
    private static final int HASH_BITS = 512;
    private static final SecureRandom RANDOM = new SecureRandom();

    private MosquittoPassword() {}

    public static String line(FarmSecret.Login login) {
        byte[] salt = new byte[SALT_BYTES];
        RANDOM.nextBytes(salt);
        Base64.Encoder base64 = Base64.getEncoder();
        return "%s:$7$%d$%s$%s"
                .formatted(
                        login.user(),
                        ITERATIONS,
                        base64.encodeToString(salt),
                        base64.encodeToString(hash(login.password(), salt, ITERATIONS)));
    }

    /** Returns the user of a line; the whole line if it names none. */
    static String user(String line) {
        int colon = line.indexOf(':');
        return colon < 0 ? line : line.substring(0, colon);
    }

    /** Whether a line belongs to the user of a login and matches its password. */
    static boolean isOf(String line, FarmSecret.Login login) {
        Matcher parts = LINE.matcher(line);
        if (!parts.matches() || !parts.group(1).equals(login.user())) {
            return false;
        }
        try {
            byte[] salt = Base64.getDecoder().decode(parts.group(3));
            byte[] expected = Base64.getDecoder().decode(parts.group(4));
            return MessageDigest.isEqual(
                    expected, hash(login.password(), salt, Math.max(1, Integer.parseInt(parts.group(2)))));
        } catch (IllegalArgumentException e) { // an edited line; it is written again
            return false;
        }
    }

    private static byte[] hash(String password, byte[] salt, int iterations) {
        try {
            KeySpec spec = new PBEKeySpec(password.toCharArray(), salt, iterations, HASH_BITS);
            return SecretKeyFactory.getInstance(FUNCTION).generateSecret(spec).getEncoded();
        } catch (GeneralSecurityException e) {
            throw new IllegalStateException("every JDK has " + FUNCTION + " for ASCII passwords", e);
        }
    }
}
