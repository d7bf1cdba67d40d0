package io.furrow.connect.source;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.security.KeyFactory;
import java.security.KeyStore;
import java.security.KeyStoreException;
import java.security.PrivateKey;
import java.security.cert.Certificate;
import java.security.cert.CertificateFactory;
import java.security.spec.InvalidKeySpecException;
import java.security.spec.PKCS8EncodedKeySpec;
import java.util.Base64;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.source.TlsOptions.Store;

/** Key stores and trust stores read from files; {@link ConfigException} naming the option and the file where that fails. */
final class KeyStores {
    private static final Pattern KEY =
            Pattern.compile("-----BEGIN PRIVATE KEY-----(.+?)-----END PRIVATE KEY-----", Pattern.DOTALL);
    private static final Pattern CERTIFICATE =
            Pattern.compile("-----BEGIN CERTIFICATE-----.+?-----END CERTIFICATE-----", Pattern.DOTALL);

    private KeyStores() {}

    /** A store with the server's key, under the store's own password. */
    static KeyStore keys(Store store) {
        return read(TlsOptions.KEYSTORE, store, true);
    }

    /** A store with certificates. */
    static KeyStore certificates(Store store) {
        return read(TlsOptions.TRUSTSTORE, store, false);
    }

    private static KeyStore read(String option, Store store, boolean withKey) {
        try {
            return store.type().equals("PEM") ? pem(store, withKey) : binary(store);
        } catch (IOException | GeneralSecurityException e) {
            // Its message never holds the password; the file's name is no secret.
            throw new ConfigException(option, store.location(), "cannot be read as " + store.type() + ": " + e);
        }
    }

    private static KeyStore binary(Store store) throws IOException, GeneralSecurityException {
        KeyStore keys = KeyStore.getInstance(store.type());
        try (InputStream file = Files.newInputStream(store.location())) {
            keys.load(file, store.password().value().toCharArray());
        }
        return keys;
    }

    private static KeyStore pem(Store store, boolean withKey) throws IOException, GeneralSecurityException {
        String text = Files.readString(store.location(), StandardCharsets.US_ASCII);
        List<Certificate> certificates = certificates(text);
        KeyStore keys = KeyStore.getInstance("PKCS12");
        keys.load(null, null);
        if (withKey) {
            char[] password = store.password().value().toCharArray();
            keys.setKeyEntry("server", key(text, store.location()), password, certificates.toArray(Certificate[]::new));
        } else {
            for (Certificate each : certificates) {
                keys.setCertificateEntry("ca" + keys.size(), each);
            }
        }
        return keys;
    }

    private static List<Certificate> certificates(String text) throws GeneralSecurityException {
        String certificates = String.join(
                "\n",
                CERTIFICATE.matcher(text).results().map(found -> found.group()).toList());
        if (certificates.isEmpty()) {
            throw new KeyStoreException("there is no BEGIN CERTIFICATE in it");
        }
        return List.copyOf(CertificateFactory.getInstance("X.509")
                .generateCertificates(new ByteArrayInputStream(certificates.getBytes(StandardCharsets.US_ASCII))));
    }

    private static PrivateKey key(String text, Path location) throws GeneralSecurityException {
        Matcher found = KEY.matcher(text);
        if (!found.find()) {
            throw new KeyStoreException("there is no BEGIN PRIVATE KEY in it (PKCS 8, not encrypted)");
        }
        PKCS8EncodedKeySpec spec =
                new PKCS8EncodedKeySpec(Base64.getMimeDecoder().decode(found.group(1)));
        for (String algorithm : List.of("RSA", "EC", "Ed25519")) {
            try {
                return KeyFactory.getInstance(algorithm).generatePrivate(spec);
            } catch (InvalidKeySpecException e) {
                continue; // it is one of the others
            }
        }
        throw new KeyStoreException("the key in " + location + " is neither RSA nor EC nor Ed25519");
    }
}
