package io.furrow.connect.broker;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import javax.net.ssl.KeyManagerFactory;
import javax.net.ssl.SSLContext;

import com.sun.net.httpserver.HttpsConfigurator;
import com.sun.net.httpserver.HttpsServer;
import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigException;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.event.FiwareScope;
import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class BrokerOptionsTest {
    @Test
    void letsTheUrlBeLeftOutWhereItIsOptional() {
        assertThat(options(Optional.of("Empty for none."), Map.of()).url()).isEmpty();
        assertThatThrownBy(() -> options(Optional.empty(), Map.of()))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining(BrokerOptions.URL);
    }

    @Test
    void sendsTheTokenInTheHeaderThatIsNamed() {
        BrokerSettings settings = options(
                        Optional.empty(),
                        Map.of(
                                BrokerOptions.URL, "http://orion:1026",
                                BrokerOptions.AUTH_TOKEN, "Bearer x",
                                BrokerOptions.AUTH_HEADER, "Authorization"))
                .settings();

        assertThat(settings.headers().get("Authorization").value()).isEqualTo("Bearer x");
        assertThat(options(Optional.empty(), Map.of(BrokerOptions.URL, "http://orion:1026"))
                        .settings()
                        .headers())
                .isEmpty();
    }

    @Test
    void takesTheTokenFromAFileInstead(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("token"), "Bearer x\n");
        Map<String, String> given = Map.of(
                BrokerOptions.URL, "http://orion:1026",
                BrokerOptions.AUTH_TOKEN_FILE, file.toString(),
                BrokerOptions.AUTH_HEADER, "Authorization");
        Map<String, String> sent = new HashMap<>();

        options(Optional.empty(), given).settings().token().addTo(sent::put);

        assertThat(sent).containsExactly(Map.entry("Authorization", "Bearer x"));
        Map<String, String> both = new HashMap<>(given);
        both.put(BrokerOptions.AUTH_TOKEN, "y");
        assertThatThrownBy(() -> options(Optional.empty(), both))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining("excludes " + BrokerOptions.AUTH_TOKEN);
    }

    @ParameterizedTest
    @CsvSource({
        "context.broker.auth.token.file, /nowhere/token",
        "context.broker.auth.header, Host",
        "context.broker.auth.header, two words",
        "context.broker.auth.token, ä",
        "context.broker.ssl.truststore.location, /nowhere/store.p12"
    })
    void namesTheOptionThatCannotBeUsed(String option, String value) {
        assertThatThrownBy(
                        () -> options(Optional.empty(), Map.of(BrokerOptions.URL, "https://orion:1026", option, value)))
                .isInstanceOf(ConfigException.class)
                .hasMessageContaining(option);
    }

    @Test
    void showsTheTruststoreOnlyForHttps() {
        ConfigDef.Recommender shown =
                definition(Optional.empty()).configKeys().get(BrokerOptions.TRUSTSTORE).recommender;

        assertThat(shown.visible(BrokerOptions.TRUSTSTORE, Map.of(BrokerOptions.URL, "https://orion")))
                .isTrue();
        assertThat(shown.visible(BrokerOptions.TRUSTSTORE, Map.of(BrokerOptions.URL, "http://orion")))
                .isFalse();
    }

    @Tag("full")
    @ParameterizedTest
    @ValueSource(strings = {"trust.p12", "trust.jks", "trust.pem"})
    void trustsTheCertificatesOfTheFileAndNoOthers(String file, @TempDir Path directory) throws Exception {
        Path key = directory.resolve("key.p12");
        keytool("-genkeypair -alias b -keyalg EC -dname CN=127.0.0.1 -ext san=ip:127.0.0.1")
                .on(key);
        Path pem = directory.resolve("trust.pem");
        keytool("-exportcert -alias b -rfc -file " + pem).on(key);
        Path trust = directory.resolve(file);
        if (!trust.equals(pem)) {
            String type = file.endsWith("jks") ? "JKS" : "PKCS12";
            keytool("-importcert -noprompt -alias b -file " + pem + " -storetype " + type)
                    .on(trust);
        }
        HttpsServer server = httpsServer(key);
        URI url = URI.create("https://127.0.0.1:" + server.getAddress().getPort());
        try {
            assertThat(ask(url, Map.of())).isInstanceOf(Outcome.Unavailable.class);
            assertThat(ask(
                            url,
                            Map.of(
                                    BrokerOptions.TRUSTSTORE,
                                    trust.toString(),
                                    trust.equals(pem)
                                            ? BrokerOptions.TRUSTSTORE_TYPE
                                            : BrokerOptions.TRUSTSTORE_PASSWORD,
                                    trust.equals(pem) ? "PEM" : "secret")))
                    .isInstanceOf(Outcome.Done.class);
        } finally {
            server.stop(0);
        }
    }

    private static Outcome ask(URI url, Map<String, String> more) {
        Map<String, String> all = new HashMap<>(more);
        all.put(BrokerOptions.URL, url.toString());
        return new BrokerClient(options(Optional.empty(), all).settings())
                .send(BrokerRequest.get(FiwareScope.DEFAULT, "/version"));
    }

    private static HttpsServer httpsServer(Path key) throws Exception {
        KeyManagerFactory keys = KeyManagerFactory.getInstance(KeyManagerFactory.getDefaultAlgorithm());
        keys.init(java.security.KeyStore.getInstance(key.toFile(), "secret".toCharArray()), "secret".toCharArray());
        SSLContext context = SSLContext.getInstance("TLS");
        context.init(keys.getKeyManagers(), null, null);
        HttpsServer server = HttpsServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        server.setHttpsConfigurator(new HttpsConfigurator(context));
        server.createContext("/", exchange -> {
            exchange.sendResponseHeaders(204, -1);
            exchange.close();
        });
        server.start();
        return server;
    }

    private interface Keytool {
        void on(Path store) throws IOException, InterruptedException;
    }

    private static Keytool keytool(String words) {
        return store -> {
            TestProcess.keytool(words + " -keystore " + store + " -storepass secret");
            assertThat(Files.exists(store)).isTrue();
        };
    }

    private static BrokerOptions options(Optional<String> urlHelp, Map<String, String> values) {
        return new BrokerOptions(new AbstractConfig(definition(urlHelp), values));
    }

    private static ConfigDef definition(Optional<String> urlHelp) {
        ConfigDef options = new ConfigDef();
        BrokerOptions.define(options, urlHelp);
        return options;
    }
}
