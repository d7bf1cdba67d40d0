package io.furrow.control.rest.access;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.security.Key;
import java.security.KeyStore;
import java.security.PrivateKey;
import java.security.Signature;
import java.security.cert.Certificate;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.stream.Stream;

import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.SslConfigs;
import org.apache.kafka.common.config.types.Password;
import org.apache.kafka.common.security.auth.SslEngineFactory;
import org.apache.kafka.common.security.ssl.DefaultSslEngineFactory;

import io.furrow.model.text.FailureText;

/**
 * The files of the certificate for TLS: a certificate chain and its key in PEM, or both in a keystore.
 *
 * @param certificate chain in PEM, the server's own certificate first; null with a keystore
 * @param key in PEM (PKCS #8); null with a keystore
 * @param keystore PKCS #12; null with PEM files
 * @param passwordFile its first line is the password of the keystore or of an encrypted key; null for none
 */
public record CertificateFiles(Path certificate, Path key, Path keystore, Path passwordFile) {
    private static final Map<String, String> SIGNATURES =
            Map.of("RSA", "SHA256withRSA", "EC", "SHA256withECDSA", "EdDSA", "EdDSA");

    public CertificateFiles {
        boolean pem = certificate != null && key != null && keystore == null;
        boolean store = keystore != null && passwordFile != null && certificate == null && key == null;
        if (!pem && !store) {
            throw new IllegalArgumentException(
                    "TLS needs a certificate and its key in PEM, or a PKCS #12 keystore and the file of its password");
        }
    }

    /** Returns the files of a certificate chain and its unencrypted key. */
    public static CertificateFiles pem(Path certificate, Path key) {
        return new CertificateFiles(certificate, key, null, null);
    }

    public static CertificateFiles keystore(Path keystore, Path passwordFile) {
        return new CertificateFiles(null, null, keystore, passwordFile);
    }

    /**
     * The content of the files.
     *
     * @param password of the key; null for none
     */
    record Content(KeyStore keys, String password) {}

    List<Path> all() {
        return Stream.of(certificate, key, keystore, passwordFile)
                .filter(Objects::nonNull)
                .toList();
    }

    /** @throws IOException if they cannot be read or key and certificate do not match; the message names them and what to do */
    Content read() throws IOException {
        String password = passwordFile == null
                ? null
                : Files.readString(passwordFile).lines().findFirst().orElse("");
        Map<String, Object> settings = new HashMap<>();
        if (keystore == null) {
            settings.put(SslConfigs.SSL_KEYSTORE_TYPE_CONFIG, DefaultSslEngineFactory.PEM_TYPE);
            settings.put(SslConfigs.SSL_KEYSTORE_CERTIFICATE_CHAIN_CONFIG, new Password(Files.readString(certificate)));
            settings.put(SslConfigs.SSL_KEYSTORE_KEY_CONFIG, new Password(Files.readString(key)));
        } else {
            settings.put(SslConfigs.SSL_KEYSTORE_TYPE_CONFIG, "PKCS12");
            settings.put(SslConfigs.SSL_KEYSTORE_LOCATION_CONFIG, keystore.toString());
            settings.put(SslConfigs.SSL_KEYSTORE_PASSWORD_CONFIG, new Password(password));
        }
        if (password != null) {
            settings.put(SslConfigs.SSL_KEY_PASSWORD_CONFIG, new Password(password));
        }
        try (SslEngineFactory factory = new DefaultSslEngineFactory()) {
            factory.configure(new ConfigDef().withClientSslSupport().parse(settings));
            Content content = new Content(factory.keystore(), password);
            check(content);
            return content;
        } catch (KafkaException | GeneralSecurityException e) {
            throw new IOException(
                    "TLS cannot use %s (%s). A key in PEM must be PKCS #8 ('BEGIN PRIVATE KEY'; openssl pkcs8 -topk8 converts one) and belong to the first certificate"
                            .formatted(all(), reason(e)),
                    e);
        }
    }

    private static String reason(Throwable failure) {
        Throwable cause = failure;
        while (cause.getCause() != null) {
            cause = cause.getCause();
        }
        return FailureText.of(cause);
    }

    /** Checks that key and certificate match, which may fail for a moment while both files are being replaced. */
    private static void check(Content content) throws GeneralSecurityException {
        char[] password = content.password() == null ? null : content.password().toCharArray();
        int keys = 0;
        for (String alias : Collections.list(content.keys().aliases())) {
            Key key = content.keys().getKey(alias, password);
            if (key instanceof PrivateKey secret) {
                keys++;
                check(secret, content.keys().getCertificate(alias));
            }
        }
        if (keys == 0) {
            throw new GeneralSecurityException("there is no private key");
        }
    }

    private static void check(PrivateKey key, Certificate certificate) throws GeneralSecurityException {
        Signature signature = Signature.getInstance(SIGNATURES.getOrDefault(key.getAlgorithm(), "SHA256withRSA"));
        signature.initSign(key);
        byte[] signed = signature.sign();
        signature.initVerify(certificate);
        if (!signature.verify(signed)) {
            throw new GeneralSecurityException("the key does not belong to the certificate");
        }
    }
}
