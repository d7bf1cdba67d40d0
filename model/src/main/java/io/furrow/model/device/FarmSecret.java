package io.furrow.model.device;

import java.io.IOException;
import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.util.Base64;
import javax.crypto.Mac;
import javax.crypto.spec.SecretKeySpec;

/**
 * The one secret of a farm, of which the API key of each mission and the MQTT password of each device are made (HMAC-SHA-256): the
 * control plane, which provisions devices, and whoever hosts them come to the same without a password on any topic. Whoever has
 * the secret has all of them.
 */
public final class FarmSecret {
    private static final int LEAST_BYTES = 16;
    private static final int KEY_CHARACTERS = 22;
    private static final String MAC = "HmacSHA256";

    private final SecretKeySpec key;

    /** As whom to connect to the MQTT broker; the password is left out of {@link #toString()}. */
    public record Login(String user, String password) {
        @Override
        public String toString() {
            return user;
        }
    }

    /** @throws IllegalArgumentException where there are fewer than 16 bytes */
    public FarmSecret(byte[] secret) {
        if (secret.length < LEAST_BYTES) {
            throw new IllegalArgumentException(
                    "a farm's secret has at least %d bytes, this one %d; make one with: openssl rand -base64 32"
                            .formatted(LEAST_BYTES, secret.length));
        }
        this.key = new SecretKeySpec(secret, MAC);
    }

    /**
     * Reads the first line of a file.
     *
     * @throws IOException if it cannot be read or is too short; the message says which and what to do
     */
    public static FarmSecret read(Path file) throws IOException {
        try {
            String line = Files.readString(file).lines().findFirst().orElse("").strip();
            return new FarmSecret(line.getBytes(StandardCharsets.UTF_8));
        } catch (IllegalArgumentException e) {
            throw new IOException(file + ": " + e.getMessage(), e);
        }
    }

    /** What devices of a mission put before their topics, {@code /<apikey>/<device>/attrs}: 22 of {@code A-Za-z0-9_-}. */
    public String apiKey(String mission) {
        return code("apikey", mission, "");
    }

    /**
     * The login of a device: user {@code <mission>.<device>}, the device as in a URL's query.
     *
     * @param device its id at the IoT Agent
     */
    public Login device(String mission, String device) {
        String user = mission + "." + URLEncoder.encode(device, StandardCharsets.UTF_8);
        return new Login(user, code("device", mission, device));
    }

    /** The login of the gateway that speaks for all devices of a mission: user {@code <mission>}. */
    public Login gateway(String mission) {
        return new Login(mission, code("gateway", mission, ""));
    }

    private String code(String use, String mission, String device) {
        try {
            Mac mac = Mac.getInstance(MAC);
            mac.init(key);
            byte[] code = mac.doFinal(String.join("\n", use, mission, device).getBytes(StandardCharsets.UTF_8));
            return Base64.getUrlEncoder().withoutPadding().encodeToString(code).substring(0, KEY_CHARACTERS);
        } catch (GeneralSecurityException e) {
            throw new IllegalStateException("every JDK has " + MAC, e);
        }
    }
}
