package io.furrow.control.rest;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Clock;

import org.junit.jupiter.api.Test;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.access.CertificateFiles;
import io.furrow.kafka.Readiness;

import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Checks the requirements for the address of the API. */
class RestSettingsTest {
    private static final Path FILE = Path.of("file");

    private final RestSettings everywhere = RestSettings.on(0).withHost("0.0.0.0");

    @Test
    void needsNothingOnLoopback() {
        for (String host : new String[] {"127.0.0.1", "localhost", "::1"}) {
            assertThatCode(() -> RestSettings.on(0).withHost(host).check()).doesNotThrowAnyException();
        }
    }

    @Test
    void needsTokensOnOtherAddresses() {
        assertThatThrownBy(() -> RestApi.start(
                        ControlSettings.of(new java.util.Properties()), everywhere, new Readiness(Clock.systemUTC())))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("listens on 0.0.0.0 only with tokens");
    }

    @Test
    void needsTlsOnOtherAddressesUnlessAProxyTerminatesIt() {
        RestSettings plain = everywhere.withTokens(FILE);

        assertThatThrownBy(plain::check)
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("listens on 0.0.0.0 only with TLS", "--api-certificate", "--api-insecure");
        assertThatCode(() -> plain.withInsecure(true).check()).doesNotThrowAnyException();
        assertThatCode(() ->
                        plain.withCertificate(CertificateFiles.pem(FILE, FILE)).check())
                .doesNotThrowAnyException();
    }
}
