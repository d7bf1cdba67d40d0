package io.furrow.connect.source;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.cert.X509Certificate;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import javax.net.ssl.SSLParameters;

import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.connect.ledger.Metric;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class TlsTest {
    @TempDir
    static Path directory;

    private static TlsKeys keys;

    @BeforeAll
    static void makeKeys() throws Exception {
        keys = new TlsKeys(directory);
    }

    @ParameterizedTest
    @ValueSource(strings = {"PKCS12 server.p12", "JKS server.p12", "PEM server.pem", "PEM server-ec.pem"})
    void takesNotificationsOverTls(String kind) throws Exception {
        String[] typeAndFile = kind.split(" ");
        String name = typeAndFile[1].replaceAll("\\..*", "");
        List<String> options = new ArrayList<>(List.of("ssl.keystore.type", typeAndFile[0]));
        options.addAll(List.of("ssl.keystore.location", keys.file(typeAndFile[1])));
        if (!typeAndFile[0].equals("PEM")) {
            options.addAll(List.of("ssl.keystore.password", TlsKeys.PASSWORD));
        }
        try (NotificationRig rig = new NotificationRig(options.toArray(String[]::new))) {
            assertThat(post(rig, keys.client(name, null)).statusCode()).isEqualTo(200);
            assertThat(rig.recordLog.taken).hasSize(1);
            assertThatThrownBy(() -> rig.post("{\"id\": \"in plain text\"}").join())
                    .hasRootCauseInstanceOf(IOException.class);
        }
    }

    @Test
    void takesAKeyThatIsGivenAsAnOption() throws Exception {
        String pem = Files.readString(directory.resolve("server-ec.pem"));
        int certificate = pem.indexOf("-----BEGIN CERTIFICATE-----");
        try (NotificationRig rig = new NotificationRig(
                "ssl.keystore.type", "PEM",
                "ssl.keystore.key", pem.substring(0, certificate),
                "ssl.keystore.certificate.chain", pem.substring(certificate))) {
            assertThat(post(rig, keys.client("server-ec", null)).statusCode()).isEqualTo(200);
        }
    }

    @Test
    void takesNotificationsOfKnownClientsOnlyWhereThatIsDesired() throws Exception {
        try (NotificationRig rig = new NotificationRig(withClientAuth("client.p12"))) {
            assertThat(post(rig, keys.client("server", "client")).statusCode()).isEqualTo(200);
            assertThatThrownBy(() -> post(rig, keys.client("server", null))).isInstanceOf(IOException.class);
            assertThatThrownBy(() -> post(rig, keys.client("server", "server-ec")))
                    .isInstanceOf(IOException.class);
        }
    }

    @Test
    void showsTheHealthToProbesWithoutACertificateOnItsOwnPort() throws Exception {
        List<String> options = new ArrayList<>(List.of(withClientAuth("client.p12")));
        options.addAll(List.of("health.port", "0"));
        try (NotificationRig rig = new NotificationRig(options.toArray(String[]::new))) {
            URI health = URI.create("http://127.0.0.1:" + rig.healthPort() + "/health");

            assertThat(rig.send(HttpRequest.newBuilder(health).build()).join().statusCode())
                    .isEqualTo(200);
        }
    }

    @Test
    void speaksOnlyTheProtocolsThatAreEnabled() throws Exception {
        List<String> options = new ArrayList<>(List.of(withKeys("server.p12")));
        options.addAll(List.of("ssl.enabled.protocols", "TLSv1.3"));
        try (NotificationRig rig = new NotificationRig(options.toArray(String[]::new))) {
            SSLParameters old = new SSLParameters();
            old.setProtocols(new String[] {"TLSv1.2"});
            HttpClient client = HttpClient.newBuilder()
                    .sslContext(keys.context("server", null))
                    .sslParameters(old)
                    .build();

            assertThatThrownBy(() -> post(rig, client)).isInstanceOf(IOException.class);
            assertThat(post(rig, keys.client("server", null)).statusCode()).isEqualTo(200);
        }
    }

    @Test
    void takesUpNewKeysAndNewTrustWhileItListens() throws Exception {
        keys.copy("server.p12", "renewed.p12");
        keys.copy("client.p12", "trusted.p12");
        List<String> options = new ArrayList<>(List.of(withClientAuth("trusted.p12")));
        options.set(options.indexOf(keys.file("server.p12")), keys.file("renewed.p12"));
        try (NotificationRig rig = new NotificationRig(options.toArray(String[]::new))) {
            assertThat(post(rig, keys.client("server", "client")).statusCode()).isEqualTo(200);

            keys.copy("other.p12", "renewed.p12");
            await().ignoreExceptions()
                    .untilAsserted(() -> assertThat(
                                    post(rig, keys.client("other", "client")).statusCode())
                            .isEqualTo(200));
            assertThatThrownBy(() -> post(rig, keys.client("other", "other"))).isInstanceOf(IOException.class);

            keys.copy("other.p12", "trusted.p12");
            await().ignoreExceptions()
                    .untilAsserted(() -> assertThat(
                                    post(rig, keys.client("other", "other")).statusCode())
                            .isEqualTo(200));
        }
    }

    @Test
    void goesOnWithTheKeysFromBeforeWhereNewOnesCannotBeUsed() throws Exception {
        keys.copy("server.p12", "broken.p12");
        try (NotificationRig rig = new NotificationRig(withKeys("broken.p12"))) {
            Files.writeString(directory.resolve("broken.p12"), "no key store");

            await().during(Duration.ofMillis(1500))
                    .until(() -> post(rig, keys.client("server", null)).statusCode() == 200);
            keys.copy("other.p12", "broken.p12");

            await().ignoreExceptions()
                    .untilAsserted(() -> assertThat(
                                    post(rig, keys.client("other", null)).statusCode())
                            .isEqualTo(200));
        }
    }

    @Test
    void showsWhenTheCertificateExpires() throws Exception {
        long expiry = ((X509Certificate) keys.load("server").getCertificate("server"))
                .getNotAfter()
                .toInstant()
                .getEpochSecond();
        try (NotificationRig rig = new NotificationRig(withKeys("server.p12"))) {
            assertThat(rig.ledger.all())
                    .filteredOn(gauge -> gauge.name().equals("certificateExpirySeconds"))
                    .singleElement()
                    .satisfies(gauge -> assertThat(gauge.now()).isEqualTo(expiry));
        }
        try (NotificationRig rig = new NotificationRig()) {
            assertThat(rig.ledger.all()).extracting(Metric::name).doesNotContain("certificateExpirySeconds");
        }
    }

    @Test
    void resetsATlsConnectionUnderOverload() throws Exception {
        List<String> options = new ArrayList<>(List.of(withKeys("server.p12")));
        options.addAll(List.of("overload.hold.ms", "100"));
        try (NotificationRig rig = new NotificationRig(options.toArray(String[]::new))) {
            rig.recordLog.answer = java.util.Optional.empty();

            assertThatThrownBy(() -> post(rig, keys.client("server", null))).isInstanceOf(IOException.class);
            assertThat(rig.ledger.overload.sum()).isEqualTo(1);
        }
    }

    @ParameterizedTest
    @ValueSource(strings = {"absent.p12", "server.pem"})
    void saysWhichFileCannotBeRead(String file) {
        assertThatThrownBy(() -> new NotificationRig(withKeys(file)).close())
                .isInstanceOf(ConfigException.class)
                .hasMessageContainingAll("ssl.keystore.location", file)
                .hasMessageNotContaining(TlsKeys.PASSWORD);
    }

    private static String[] withKeys(String file) {
        return new String[] {
            "ssl.keystore.type",
            "PKCS12",
            "ssl.keystore.location",
            keys.file(file),
            "ssl.keystore.password",
            TlsKeys.PASSWORD
        };
    }

    private static String[] withClientAuth(String trusted) {
        List<String> options = new ArrayList<>(List.of(withKeys("server.p12")));
        options.addAll(List.of("ssl.truststore.type", "PKCS12", "ssl.truststore.location", keys.file(trusted)));
        options.addAll(List.of("ssl.truststore.password", TlsKeys.PASSWORD, "ssl.client.auth", "required"));
        return options.toArray(String[]::new);
    }

    private static HttpResponse<String> post(NotificationRig rig, HttpClient client) throws Exception {
        URI uri = URI.create("https://127.0.0.1:" + rig.port() + "/v2/notify");
        HttpRequest request = HttpRequest.newBuilder(uri)
                .timeout(NotificationRig.TIMEOUT)
                .POST(BodyPublishers.ofString("{\"id\": \"a\"}"))
                .build();
        return client.send(request, HttpResponse.BodyHandlers.ofString());
    }
}
