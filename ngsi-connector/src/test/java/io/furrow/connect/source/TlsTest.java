package io.furrow.connect.source;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.KeyStore;
import java.util.ArrayList;
import java.util.Base64;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import javax.net.ssl.KeyManagerFactory;
import javax.net.ssl.SSLContext;
import javax.net.ssl.TrustManagerFactory;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class TlsTest {
    private static final char[] PASSWORD = "p4ssword".toCharArray();

    @TempDir
    static Path directory;

    @BeforeAll
    static void makeKeys() throws Exception {
        makeKey("server", "RSA");
        makeKey("server-ec", "EC");
        makeKey("client", "RSA");
        writePem("server");
        writePem("server-ec");
    }

    @ParameterizedTest
    @ValueSource(strings = {"PKCS12 server.p12", "PEM server.pem", "PEM server-ec.pem"})
    void takesNotificationsOverTls(String keys) throws Exception {
        String[] typeAndFile = keys.split(" ");
        String name = typeAndFile[1].replaceAll("\\..*", "");
        try (ReceptionRig rig = new ReceptionRig(
                "tls.keystore.location",
                directory.resolve(typeAndFile[1]).toString(),
                "tls.keystore.type",
                typeAndFile[0],
                "tls.keystore.password",
                typeAndFile[0].equals("PEM") ? "" : new String(PASSWORD))) {
            assertThat(post(rig, client(name, null)).statusCode()).isEqualTo(200);
            assertThat(rig.intake.taken).hasSize(1);
            assertThatThrownBy(() -> rig.post("{\"id\": \"in plain text\"}").join())
                    .hasRootCauseInstanceOf(IOException.class);
        }
    }

    @Test
    void takesNotificationsOfKnownClientsOnlyWhereThatIsWanted() throws Exception {
        try (ReceptionRig rig = new ReceptionRig(
                "tls.keystore.location",
                directory.resolve("server.p12").toString(),
                "tls.keystore.password",
                new String(PASSWORD),
                "tls.truststore.location",
                directory.resolve("client.p12").toString(),
                "tls.truststore.password",
                new String(PASSWORD),
                "tls.client.auth",
                "required")) {
            assertThat(post(rig, client("server", "client")).statusCode()).isEqualTo(200);
            assertThatThrownBy(() -> post(rig, client("server", null))).isInstanceOf(IOException.class);
            assertThatThrownBy(() -> post(rig, client("server", "server-ec"))).isInstanceOf(IOException.class);
        }
    }

    @Test
    void resetsATlsConnectionUnderOverload() throws Exception {
        try (ReceptionRig rig = new ReceptionRig(
                "tls.keystore.location",
                directory.resolve("server.p12").toString(),
                "tls.keystore.password",
                new String(PASSWORD),
                "overload.hold.ms",
                "100")) {
            rig.intake.answer = java.util.Optional.empty();

            assertThatThrownBy(() -> post(rig, client("server", null))).isInstanceOf(IOException.class);
            assertThat(rig.ledger.overload.sum()).isEqualTo(1);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"absent.p12", "server.pem"})
    void saysWhichFileCannotBeRead(String file) {
        assertThatThrownBy(() -> new ReceptionRig(
                                "tls.keystore.location",
                                directory.resolve(file).toString(),
                                "tls.keystore.password",
                                new String(PASSWORD))
                        .close())
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("tls.keystore.location")
                .hasMessageContaining(file)
                .hasMessageNotContaining(new String(PASSWORD));
    }

    private static HttpResponse<String> post(ReceptionRig rig, HttpClient client) throws Exception {
        URI uri = URI.create("https://127.0.0.1:" + rig.port() + "/v2/notify");
        HttpRequest request = HttpRequest.newBuilder(uri)
                .timeout(ReceptionRig.PATIENCE)
                .POST(BodyPublishers.ofString("{\"id\": \"a\"}"))
                .build();
        return client.send(request, HttpResponse.BodyHandlers.ofString());
    }

    /** A client that trusts one certificate, and shows another unless it is null. */
    private static HttpClient client(String trusted, String shown) throws Exception {
        TrustManagerFactory trust = TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
        trust.init(load(trusted));
        KeyManagerFactory keys = KeyManagerFactory.getInstance(KeyManagerFactory.getDefaultAlgorithm());
        if (shown != null) {
            keys.init(load(shown), PASSWORD);
        }
        SSLContext tls = SSLContext.getInstance("TLS");
        tls.init(shown == null ? null : keys.getKeyManagers(), trust.getTrustManagers(), null);
        return HttpClient.newBuilder().sslContext(tls).build();
    }

    private static KeyStore load(String name) throws Exception {
        KeyStore store = KeyStore.getInstance("PKCS12");
        try (var file = Files.newInputStream(directory.resolve(name + ".p12"))) {
            store.load(file, PASSWORD);
        }
        if (name.startsWith("client") || name.startsWith("server")) {
            store.setCertificateEntry("trusted", store.getCertificate(name));
        }
        return store;
    }

    private static void makeKey(String name, String algorithm) throws Exception {
        List<String> command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "keytool").toString(),
                "-genkeypair",
                "-alias",
                name,
                "-keyalg",
                algorithm,
                "-dname",
                "CN=127.0.0.1",
                "-ext",
                "san=ip:127.0.0.1",
                "-validity",
                "2",
                "-storetype",
                "PKCS12",
                "-storepass",
                new String(PASSWORD),
                "-keystore",
                directory.resolve(name + ".p12").toString()));
        Process keytool = new ProcessBuilder(command).inheritIO().start();
        assertThat(keytool.waitFor(60, TimeUnit.SECONDS)).isTrue();
        assertThat(keytool.exitValue()).isZero();
        if (name.equals("client")) {
            // A key of one's own is no trusted certificate: the trust store has it as one.
            KeyStore store = load(name);
            try (var file = Files.newOutputStream(directory.resolve(name + ".p12"))) {
                store.store(file, PASSWORD);
            }
        }
    }

    private static void writePem(String name) throws Exception {
        KeyStore store = load(name);
        Map<String, byte[]> parts = new java.util.LinkedHashMap<>();
        parts.put("PRIVATE KEY", store.getKey(name, PASSWORD).getEncoded());
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
