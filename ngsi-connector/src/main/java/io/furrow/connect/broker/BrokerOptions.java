package io.furrow.connect.broker;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import javax.net.ssl.SSLContext;

import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.SslConfigs;
import org.apache.kafka.common.config.types.Password;
import org.apache.kafka.common.security.ssl.DefaultSslEngineFactory;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.model.file.AccessToken;

/** Options for the connection to the context broker, shared by the sink and the source. */
public record BrokerOptions(AbstractConfig config) {
    private static final Logger LOG = LoggerFactory.getLogger(BrokerOptions.class);
    private static final String PREFIX = "context.broker.";
    public static final String URL = "context.broker.url";
    public static final String TIMEOUT = "context.broker.timeout.ms";
    public static final String AUTH_HEADER = "context.broker.auth.header";
    public static final String AUTH_TOKEN = "context.broker.auth.token";
    public static final String AUTH_TOKEN_FILE = "context.broker.auth.token.file";
    static final String TRUSTSTORE = PREFIX + SslConfigs.SSL_TRUSTSTORE_LOCATION_CONFIG;
    static final String TRUSTSTORE_TYPE = PREFIX + SslConfigs.SSL_TRUSTSTORE_TYPE_CONFIG;
    static final String TRUSTSTORE_PASSWORD = PREFIX + SslConfigs.SSL_TRUSTSTORE_PASSWORD_CONFIG;

    /** HttpClient sets some headers itself and rejects these. */
    private static final String HEADER_NAME =
            "(?i)(?!(connection|content-length|expect|host|upgrade)$)[A-Za-z0-9!#$%&'*+.^_`|~-]+";

    /** Checks constraints between options. */
    public BrokerOptions {
        trust(config);
        token(config);
    }

    /** @param urlHelp the description of the URL's absence if the URL is optional; if empty, the URL is required */
    public static void define(ConfigDef options, Optional<String> urlHelp) {
        OptionGroup group = new OptionGroup(options, "Context broker");
        Validator url = urlHelp.isPresent() ? Validators.optionalHttpUrl() : Validators.httpUrl();
        group.high()
                .text(URL, urlHelp.isPresent() ? "" : ConfigDef.NO_DEFAULT_VALUE, url, "URL")
                .help("Base URL of the context broker, for instance http://orion:1026; /v2/… is added to it."
                        + urlHelp.map(help -> " " + help).orElse(""));
        group.low()
                .number(TIMEOUT, 10_000L, Range.between(1, 600_000), "Timeout (ms)")
                .help("Maximum milliseconds of one request, to the end of its answer; after that the context broker"
                        + " counts as unavailable.");
        defineAuthentication(group);
        defineTls(group);
    }

    private static void defineAuthentication(OptionGroup group) {
        group.secret(AUTH_TOKEN, "", Validators.headerSecret(), "Token")
                .help("Token that is sent with every request to the context broker, for the proxy that guards it; empty"
                        + " for none. With the header Authorization it is the whole value, for instance Bearer abc.");
        group.low()
                .text(AUTH_TOKEN_FILE, null, Validators.any("a path"), "Token file")
                .help("File on the worker whose first line is the token, instead of " + AUTH_TOKEN + ": a file that"
                        + " changes is read again without a restart, as tokens that expire need it. Unset for none.");
        Validator header = Validators.matching(HEADER_NAME, "the name of a header that HTTP itself does not use");
        group.low()
                .recommending("X-Auth-Token", "Authorization", "apikey")
                .text(AUTH_HEADER, "X-Auth-Token", header, "Token header")
                .help("Header that carries the token: X-Auth-Token for a Wilma PEP proxy, Authorization for most"
                        + " others.");
    }

    /** The trust store options of Kafka's clients, with a prefix. */
    private static void defineTls(OptionGroup group) {
        OptionGroup shown = group.low().shownIf(TRUSTSTORE, value -> !value.isEmpty());
        group.low()
                .shownIf(URL, value -> value.startsWith("https:"))
                .text(TRUSTSTORE, null, Validators.any("a path"), "Trust store")
                .help("File with the certificates that https trusts; unset for those that the JVM trusts. Only with an"
                        + " https URL.");
        shown.choice(TRUSTSTORE_TYPE, List.of("JKS", "PKCS12", DefaultSslEngineFactory.PEM_TYPE), "Trust store type")
                .help("Format of the trust store: JKS, PKCS12 or PEM.");
        shown.secret(TRUSTSTORE_PASSWORD, null, Validators.any("any text"), "Trust store password")
                .help("Password of the trust store; PEM has none.");
    }

    /** Empty if the optional URL is not set. */
    public Optional<URI> url() {
        return Optional.of(config.getString(URL)).filter(url -> !url.isEmpty()).map(URI::create);
    }

    /** @throws ConfigException if there is no URL */
    public BrokerSettings settings() {
        URI url = url().orElseThrow(() -> new ConfigException(URL, "", "is needed for this"));
        Password token = config.getPassword(AUTH_TOKEN);
        Map<String, Password> headers =
                token.value().isEmpty() ? Map.of() : Map.of(config.getString(AUTH_HEADER), token);
        return new BrokerSettings(url, Duration.ofMillis(config.getLong(TIMEOUT)), headers, trust(config))
                .withToken(token(config));
    }

    private static AccessToken token(AbstractConfig config) {
        String file = config.getString(AUTH_TOKEN_FILE);
        if (file == null || file.isEmpty()) {
            return AccessToken.NONE;
        }
        if (!config.getPassword(AUTH_TOKEN).value().isEmpty()) {
            throw new ConfigException(AUTH_TOKEN_FILE, file, "excludes " + AUTH_TOKEN);
        }
        try {
            return AccessToken.of(Path.of(file), config.getString(AUTH_HEADER), LOG::warn);
        } catch (IOException e) {
            throw new ConfigException(AUTH_TOKEN_FILE, file, e.getMessage());
        }
    }

    private static Optional<SSLContext> trust(AbstractConfig config) {
        String file = config.getString(TRUSTSTORE);
        if (file == null) {
            return Optional.empty();
        }
        try (DefaultSslEngineFactory factory = new DefaultSslEngineFactory()) {
            factory.configure(new ConfigDef().withClientSslSupport().parse(config.originalsWithPrefix(PREFIX)));
            return Optional.of(factory.sslContext());
        } catch (KafkaException e) {
            String cause = e.getCause() == null ? "" : ": " + e.getCause().getMessage();
            throw new ConfigException(TRUSTSTORE, file, "cannot be used: " + e.getMessage() + cause);
        }
    }
}
