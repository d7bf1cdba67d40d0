package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.security.KeyStore;
import java.security.cert.Certificate;
import java.security.cert.CertificateFactory;
import java.security.cert.X509Certificate;
import java.time.Clock;
import java.util.Properties;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLHandshakeException;
import javax.net.ssl.SSLParameters;
import javax.net.ssl.SSLSocket;
import javax.net.ssl.TrustManagerFactory;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.access.CertificateFiles;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.SelfSignedCertificate;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class RestApiTlsIT {
    private Path directory;

    @AutoClose
    private EmbeddedKafka kafka;

    private SelfSignedCertificate first;
    private SelfSignedCertificate second;
    private RestApi api;

    @BeforeAll
    void startKafka(@TempDir Path temporary) throws Exception {
        directory = temporary;
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        first = SelfSignedCertificate.make(directory, "first");
        second = SelfSignedCertificate.make(directory, "second");
    }

    @AfterEach
    void stopApi() {
        if (api != null) {
            api.close();
        }
    }

    @Test
    void answersOnlyOverTls() throws Exception {
        start(CertificateFiles.pem(first.certificate(), first.key()));

        assertThat(api.uri().getScheme()).isEqualTo("https");
        assertThat(health(first).statusCode()).isIn(200, 503);
        assertThatThrownBy(() -> health(second)).isInstanceOf(SSLHandshakeException.class);
        URI plain = URI.create(api.uri().toString().replace("https:", "http:") + "/health");
        assertThatThrownBy(() -> HttpClient.newHttpClient()
                        .send(HttpRequest.newBuilder(plain).build(), HttpResponse.BodyHandlers.ofString()))
                .isInstanceOf(IOException.class);
    }

    @Test
    void acceptsAKeystore() throws Exception {
        start(CertificateFiles.keystore(second.keystore(), second.password()));

        assertThat(health(second).statusCode()).isIn(200, 503);
    }

    @ParameterizedTest
    @ValueSource(strings = {"TLSv1.2", "TLSv1.3"})
    void speaks(String protocol) throws Exception {
        start(CertificateFiles.pem(first.certificate(), first.key()));

        try (SSLSocket socket = (SSLSocket) trusting(first)
                .getSocketFactory()
                .createSocket(api.uri().getHost(), api.uri().getPort())) {
            socket.setEnabledProtocols(new String[] {protocol});
            socket.startHandshake();
            assertThat(socket.getSession().getProtocol()).isEqualTo(protocol);
        }
    }

    @Test
    void reloadsACertificateOnceItIsComplete() throws Exception {
        Path certificate = Files.copy(first.certificate(), directory.resolve("live.pem"));
        Path key = Files.copy(first.key(), directory.resolve("live.key"));
        start(CertificateFiles.pem(certificate, key));
        assertThat(subject()).isEqualTo("CN=first");

        Files.copy(second.certificate(), certificate, StandardCopyOption.REPLACE_EXISTING);
        await().untilAsserted(() -> assertThat(
                        NgsiJson.read(health(first).body()).at("/warnings/0").asText())
                .startsWith("the files of the certificate cannot be used"));
        assertThat(subject()).isEqualTo("CN=first");

        Files.copy(second.key(), key, StandardCopyOption.REPLACE_EXISTING);
        await().untilAsserted(() -> assertThat(subject()).isEqualTo("CN=second"));
        assertThat(NgsiJson.read(health(second).body()).path("warnings")).isEmpty();
    }

    @Test
    void explainsProblemsOfTheFiles() {
        assertThatThrownBy(() -> start(CertificateFiles.pem(first.certificate(), second.key())))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("first.pem", "second.key", "the key does not belong to the certificate");
        assertThatThrownBy(() -> start(CertificateFiles.pem(first.key(), first.key())))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("first.key", "openssl pkcs8");
        assertThatThrownBy(() -> CertificateFiles.pem(first.certificate(), null))
                .isInstanceOf(IllegalArgumentException.class);
    }

    private void start(CertificateFiles files) throws IOException {
        Properties client = kafka.client();
        api = RestApi.start(
                ControlSettings.of(client),
                RestSettings.on(0).withCertificate(files),
                new Readiness(Clock.systemUTC()));
    }

    private HttpResponse<byte[]> health(SelfSignedCertificate trusted) throws Exception {
        return HttpClient.newBuilder()
                .sslContext(trusting(trusted))
                .build()
                .send(
                        HttpRequest.newBuilder(URI.create(api.uri() + "/health"))
                                .build(),
                        HttpResponse.BodyHandlers.ofByteArray());
    }

    /** Returns the serial number of the certificate of a new connection. */
    private String subject() throws Exception {
        try (SSLSocket socket = (SSLSocket) trusting(first, second)
                .getSocketFactory()
                .createSocket(api.uri().getHost(), api.uri().getPort())) {
            SSLParameters parameters = socket.getSSLParameters();
            parameters.setEndpointIdentificationAlgorithm("HTTPS");
            socket.setSSLParameters(parameters);
            socket.startHandshake();
            X509Certificate shown = (X509Certificate) socket.getSession().getPeerCertificates()[0];
            return shown.getSubjectX500Principal().getName();
        }
    }

    private static SSLContext trusting(SelfSignedCertificate... trusted) throws Exception {
        KeyStore store = KeyStore.getInstance(KeyStore.getDefaultType());
        store.load(null, null);
        for (SelfSignedCertificate each : trusted) {
            try (InputStream pem = Files.newInputStream(each.certificate())) {
                Certificate certificate =
                        CertificateFactory.getInstance("X.509").generateCertificate(pem);
                store.setCertificateEntry(each.certificate().toString(), certificate);
            }
        }
        TrustManagerFactory trust = TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
        trust.init(store);
        SSLContext context = SSLContext.getInstance("TLS");
        context.init(null, trust.getTrustManagers(), null);
        return context;
    }
}
