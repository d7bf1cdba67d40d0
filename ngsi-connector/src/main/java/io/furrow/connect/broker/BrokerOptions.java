package io.furrow.connect.broker;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.regex.Pattern;
import javax.net.ssl.SSLContext;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.types.Password;

import io.furrow.connect.Recommendations;
import io.furrow.connect.Validators;

/** The options that say where the context broker is and how it is asked: the same in the sink and in the source. */
public record BrokerOptions(AbstractConfig config) {
    public static final String URL = "context.broker.url";
    public static final String TIMEOUT = "context.broker.timeout.ms";
    public static final String AUTH_HEADER = "context.broker.auth.header";
    public static final String AUTH_TOKEN = "context.broker.auth.token";
    public static final String TRUSTSTORE = "context.broker.truststore.location";
    public static final String TRUSTSTORE_PASSWORD = "context.broker.truststore.password";

    private static final String GROUP = "Context broker";
    /** HttpClient sets some headers itself and refuses these. */
    private static final Pattern HEADER_NAME =
            Pattern.compile("(?i)(?!(connection|content-length|expect|host|upgrade)$)[A-Za-z0-9!#$%&'*+.^_`|~-]+");

    /** Checks what concerns more than one option. */
    public BrokerOptions {
        if (!config.getString(TRUSTSTORE).isEmpty()) {
            trust(config);
        }
    }

    /** @param urlHelp what the option says if it may be left out, else empty: then the URL is required */
    public static void define(ConfigDef options, Optional<String> urlHelp) {
        defineUrl(options, urlHelp);
        options.define(
                TIMEOUT,
                Type.LONG,
                10_000L,
                Range.between(1, 600_000),
                Importance.LOW,
                "Milliseconds that one request may take, to the end of its answer; after that the context broker counts"
                        + " as away.",
                GROUP,
                2,
                Width.SHORT,
                "Timeout (ms)");
        defineAuthentication(options);
        defineTls(options);
    }

    private static void defineUrl(ConfigDef options, Optional<String> urlHelp) {
        options.define(
                URL,
                Type.STRING,
                urlHelp.isPresent() ? "" : ConfigDef.NO_DEFAULT_VALUE,
                urlHelp.isPresent() ? Validators.optionalHttpUrl() : Validators.httpUrl(),
                Importance.HIGH,
                "Base URL of the context broker, for instance http://orion:1026; /v2/… is added to it."
                        + urlHelp.map(help -> " " + help).orElse(""),
                GROUP,
                1,
                Width.MEDIUM,
                "URL");
    }

    private static void defineAuthentication(ConfigDef options) {
        options.define(
                AUTH_TOKEN,
                Type.PASSWORD,
                "",
                Validators.headerSecret(),
                Importance.MEDIUM,
                "Token that is sent with every request to the context broker, for the proxy that guards it; empty for"
                        + " none. With the header Authorization it is all of the value, for instance Bearer abc.",
                GROUP,
                3,
                Width.LONG,
                "Token");
        options.define(
                AUTH_HEADER,
                Type.STRING,
                "X-Auth-Token",
                Validators.matching(HEADER_NAME, "the name of a header that HTTP itself does not use"),
                Importance.LOW,
                "Header that carries the token: X-Auth-Token for a Wilma PEP proxy, Authorization for most others.",
                GROUP,
                4,
                Width.MEDIUM,
                "Token header",
                Recommendations.values("X-Auth-Token", "Authorization", "apikey"));
    }

    private static void defineTls(ConfigDef options) {
        options.define(
                TRUSTSTORE,
                Type.STRING,
                "",
                Validators.matching(Pattern.compile(".*"), "a path"),
                Importance.LOW,
                "File with the certificates that https trusts, PEM (.pem, .crt), JKS (.jks) or PKCS12 (all others); empty"
                        + " for those that the JVM trusts. Only with an https URL.",
                GROUP,
                5,
                Width.LONG,
                "Truststore",
                List.of(TRUSTSTORE_PASSWORD),
                Recommendations.shownIf(URL, value -> value.startsWith("https:")));
        options.define(
                TRUSTSTORE_PASSWORD,
                Type.PASSWORD,
                "",
                Validators.secret(),
                Importance.LOW,
                "Password of the truststore; PEM has none.",
                GROUP,
                6,
                Width.MEDIUM,
                "Truststore password",
                Recommendations.shownIf(
                        TRUSTSTORE, value -> !value.isEmpty() && !TrustedCertificates.isPem(Path.of(value))));
    }

    /** Empty where the option may be left out and was. */
    public Optional<URI> url() {
        return Optional.of(config.getString(URL)).filter(url -> !url.isEmpty()).map(URI::create);
    }

    /** @throws ConfigException if there is no URL */
    public BrokerSettings settings() {
        URI url = url().orElseThrow(() -> new ConfigException(URL, "", "is needed for this"));
        Password token = config.getPassword(AUTH_TOKEN);
        Map<String, Password> headers =
                token.value().isEmpty() ? Map.of() : Map.of(config.getString(AUTH_HEADER), token);
        Optional<SSLContext> tls =
                config.getString(TRUSTSTORE).isEmpty() ? Optional.empty() : Optional.of(trust(config));
        return new BrokerSettings(url, Duration.ofMillis(config.getLong(TIMEOUT)), headers, tls);
    }

    private static SSLContext trust(AbstractConfig config) {
        String file = config.getString(TRUSTSTORE);
        try {
            return TrustedCertificates.context(Path.of(file), config.getPassword(TRUSTSTORE_PASSWORD));
        } catch (IOException | GeneralSecurityException | IllegalArgumentException e) {
            throw new ConfigException(TRUSTSTORE, file, "cannot be used: " + e);
        }
    }
}
