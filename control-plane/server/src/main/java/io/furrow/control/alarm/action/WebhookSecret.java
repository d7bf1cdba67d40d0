package io.furrow.control.alarm.action;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.util.HexFormat;
import java.util.List;
import java.util.stream.Collectors;
import javax.crypto.Mac;
import javax.crypto.spec.SecretKeySpec;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.file.FileProblem;

/**
 * Signs request bodies with HMAC-SHA-256. The secret is a line of a file, at least 16 bytes. Two lines, old and new,
 * yield two signatures, so that a receiver can rotate the secret. The file is read for each signature; while it is
 * unusable, the previous secrets sign.
 */
final class WebhookSecret {
    private static final Logger LOG = LoggerFactory.getLogger(WebhookSecret.class);
    private static final String MAC = "HmacSHA256";
    private static final int MIN_BYTES = 16;
    private static final int MAX_LINES = 2;

    private final Path file;
    private List<String> secrets;

    private WebhookSecret(Path file, List<String> secrets) {
        this.file = file;
        this.secrets = secrets;
    }

    /** @throws IOException if there is no usable secret; the message says why, in which file, and what to do */
    static WebhookSecret read(Path file) throws IOException {
        return new WebhookSecret(file, secrets(file));
    }

    /**
     * Returns the value of the header {@code Furrow-Signature}: {@code t=<time>,v1=<hex>}, with another {@code v1} for
     * a second secret. The signature covers the digits of the time, a period and the body.
     *
     * @param time epoch seconds
     */
    String signature(long time, byte[] body) {
        return "t=" + time
                + current().stream()
                        .map(secret -> ",v1=" + sign(secret, time, body))
                        .collect(Collectors.joining());
    }

    private synchronized List<String> current() {
        try {
            secrets = secrets(file);
        } catch (IOException e) {
            LOG.warn("the webhook's secret cannot be read; the previous one stays in use: {}", e.getMessage());
        }
        return secrets;
    }

    private static List<String> secrets(Path file) throws IOException {
        List<String> lines;
        try {
            lines = Files.readAllLines(file).stream()
                    .map(String::strip)
                    .filter(line -> !line.isEmpty())
                    .toList();
        } catch (IOException e) {
            throw new IOException(
                    "%s cannot be read (%s). Name a file with the webhook's secret.".formatted(file, FileProblem.of(e)),
                    e);
        }
        boolean tooShort = lines.stream().anyMatch(line -> line.getBytes(StandardCharsets.UTF_8).length < MIN_BYTES);
        if (lines.isEmpty() || lines.size() > MAX_LINES || tooShort) {
            throw new IOException(
                    "%s holds no secret for the webhook: one line, or two during a change, of at least %d bytes each. Create one with: openssl rand -base64 32"
                            .formatted(file, MIN_BYTES));
        }
        return lines;
    }

    private static String sign(String secret, long time, byte[] body) {
        try {
            Mac mac = Mac.getInstance(MAC);
            mac.init(new SecretKeySpec(secret.getBytes(StandardCharsets.UTF_8), MAC));
            mac.update((time + ".").getBytes(StandardCharsets.UTF_8));
            return HexFormat.of().formatHex(mac.doFinal(body));
        } catch (GeneralSecurityException e) {
            throw new IllegalStateException("every JDK has " + MAC, e);
        }
    }
}
