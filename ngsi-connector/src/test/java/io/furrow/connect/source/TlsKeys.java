package io.furrow.connect.source;

import java.io.IOException;
import java.net.http.HttpClient;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.security.KeyStore;
import java.util.Base64;
import java.util.Map;
import javax.net.ssl.KeyManagerFactory;
import javax.net.ssl.SSLContext;
import javax.net.ssl.TrustManagerFactory;

import io.furrow.process.TestProcess;

/** Keys of servers and clients in a folder, {@code server.p12} and so on, some as {@code .pem} too; and clients that use them. */
final class TlsKeys {
    static final String PASSWORD = "p4ssword";

    private final Path directory;

    TlsKeys(Path directory) throws Exception {
        this.directory = directory;
        makeKey("server", "RSA");
        makeKey("server-ec", "EC");
        makeKey("client", "RSA");
        makeKey("other", "RSA");
        writePem("server");
        writePem("server-ec");
    }

    String file(String name) {
        return directory.resolve(name).toString();
    }

    /** Under another name first, then at once: who reads it finds the old one or the new one. */
    void copy(String from, String to) throws IOException {
        Path half = directory.resolve(to + ".half");
        Files.copy(directory.resolve(from), half, StandardCopyOption.REPLACE_EXISTING);
        Files.move(half, directory.resolve(to), StandardCopyOption.ATOMIC_MOVE, StandardCopyOption.REPLACE_EXISTING);
    }

    /** A client that trusts one certificate, and shows another unless it is null. */
    HttpClient client(String trusted, String shown) throws Exception {
        return HttpClient.newBuilder().sslContext(context(trusted, shown)).build();
    }

    SSLContext context(String trusted, String shown) throws Exception {
        TrustManagerFactory trust = TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
        trust.init(load(trusted));
        KeyManagerFactory keys = KeyManagerFactory.getInstance(KeyManagerFactory.getDefaultAlgorithm());
        if (shown != null) {
            keys.init(load(shown), PASSWORD.toCharArray());
        }
        SSLContext tls = SSLContext.getInstance("TLS");
        tls.init(shown == null ? null : keys.getKeyManagers(), trust.getTrustManagers(), null);
        return tls;
    }

    KeyStore load(String name) throws Exception {
        KeyStore store = KeyStore.getInstance("PKCS12");
        try (var file = Files.newInputStream(directory.resolve(name + ".p12"))) {
            store.load(file, PASSWORD.toCharArray());
        }
        store.setCertificateEntry("trusted", store.getCertificate(name));
        return store;
    }

    private void makeKey(String name, String algorithm) throws Exception {
        TestProcess.keytool("""
                -genkeypair -alias %s -keyalg %s -dname CN=127.0.0.1 -ext san=ip:127.0.0.1 -validity 2 \
                -storetype PKCS12 -storepass %s -keystore %s""".formatted(name, algorithm, PASSWORD, directory.resolve(name + ".p12")));
        if (name.equals("client") || name.equals("other")) {
            // A key of one's own is not a trusted certificate: the trust store has it as one.
            KeyStore store = load(name);
            try (var file = Files.newOutputStream(directory.resolve(name + ".p12"))) {
                store.store(file, PASSWORD.toCharArray());
            }
        }
    }

    private void writePem(String name) throws Exception {
        KeyStore store = load(name);
        Map<String, byte[]> parts = new java.util.LinkedHashMap<>();
        parts.put("PRIVATE KEY", store.getKey(name, PASSWORD.toCharArray()).getEncoded());
        parts.put("CERTIFICATE", store.getCertificate(name).getEncoded());
        StringBuilder pem = new StringBuilder();
        parts.forEach((kind, bytes) -> pem.append("-----BEGIN ")
                .append(kind)
                .append("-----\n")
                .append(Base64.getMimeEncoder().encodeToString(bytes))
                .append("\n-----END ")
                .append(kind)
                .append("-----\n"));
        Files.writeString(directory.resolve(name + ".pem"), pem);
    }
}
