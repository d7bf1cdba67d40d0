package io.furrow.connect.source.option;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.ConfigKey;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.SslConfigs;
import org.apache.kafka.common.security.auth.SslEngineFactory;
import org.apache.kafka.common.security.ssl.DefaultSslEngineFactory;
import org.apache.kafka.common.utils.Utils;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;

/**
 * Options for TLS on the listener: the listener options of a Kafka broker, defined and parsed by Kafka's own classes.
 */
public record TlsOptions(AbstractConfig config) {
    public static final String KEYSTORE = SslConfigs.SSL_KEYSTORE_LOCATION_CONFIG;
    static final String KEY = SslConfigs.SSL_KEYSTORE_KEY_CONFIG;
    static final String TRUSTSTORE = SslConfigs.SSL_TRUSTSTORE_LOCATION_CONFIG;
    static final String TRUSTED = SslConfigs.SSL_TRUSTSTORE_CERTIFICATES_CONFIG;
    static final String ENGINE_FACTORY = SslConfigs.SSL_ENGINE_FACTORY_CLASS_CONFIG;
    /** Defined by Kafka for brokers, in a class that is not public. */
    static final String CLIENT_AUTH = "ssl.client.auth";

    private static final String GROUP = "TLS";
    private static final String PREFIX = "ssl.";
    private static final String NO_CLIENT_AUTH = "none";

    private static final String TURNS_ON =
            " It enables TLS for notifications; a file that has changed is loaded without a restart.";

    /** Any of these enables TLS. */
    private static final Set<String> DECIDING =
            Set.of(KEYSTORE, KEY, SslConfigs.SSL_KEYSTORE_CERTIFICATE_CHAIN_CONFIG, ENGINE_FACTORY);
    /** Without effect unless one of those is set. */
    private static final List<String> USELESS_ALONE = List.of(
            SslConfigs.SSL_KEYSTORE_PASSWORD_CONFIG,
            SslConfigs.SSL_KEY_PASSWORD_CONFIG,
            TRUSTSTORE,
            SslConfigs.SSL_TRUSTSTORE_PASSWORD_CONFIG,
            TRUSTED);

    /** The options of Kafka's clients, except for the check of a server's name. */
    private static final Map<String, ConfigKey> OF_KAFKA = ofKafka();

    public TlsOptions {
        if (!isOn(config)) {
            USELESS_ALONE.stream()
                    .filter(option -> config.values().get(option) != null)
                    .findFirst()
                    .ifPresent(option -> {
                        throw new ConfigException(
                                option, config.values().get(option), "needs " + KEYSTORE + " or " + KEY + " beside it");
                    });
        }
        if (!config.getString(CLIENT_AUTH).equals(NO_CLIENT_AUTH) && !trustsSomebody(config)) {
            throw new ConfigException(
                    CLIENT_AUTH,
                    config.getString(CLIENT_AUTH),
                    "needs " + TRUSTSTORE + " or " + TRUSTED + ", which hold the trusted clients");
        }
    }

    private static boolean trustsSomebody(AbstractConfig config) {
        return config.values().get(TRUSTSTORE) != null
                || config.values().get(TRUSTED) != null
                || config.values().get(ENGINE_FACTORY) != null;
    }

    public static void define(ConfigDef options) {
        for (ConfigKey key : OF_KAFKA.values()) {
            options.define(
                    key.name,
                    key.type,
                    key.defaultValue,
                    key.validator == null ? Validators.any("any") : key.validator,
                    key.importance,
                    inMarkdown(key.documentation) + (key.name.equals(KEYSTORE) ? TURNS_ON : ""),
                    GROUP,
                    options.configKeys().size() + 1,
                    Width.LONG,
                    key.name.substring(PREFIX.length()).replace('.', ' '));
        }
        new OptionGroup(options, GROUP)
                .choice(CLIENT_AUTH, List.of(NO_CLIENT_AUTH, "requested", "required"), "client certificates")
                .help("Whether clients present a certificate that the trust store trusts: required, requested (a"
                        + " presented one must be valid) or none.");
    }

    private static Map<String, ConfigKey> ofKafka() {
        Map<String, ConfigKey> options =
                new LinkedHashMap<>(new ConfigDef().withClientSslSupport().configKeys());
        options.remove(SslConfigs.SSL_ENDPOINT_IDENTIFICATION_ALGORITHM_CONFIG);
        return options;
    }

    /** Kafka's documentation is HTML. */
    private static String inMarkdown(String documentation) {
        String plain = documentation.replaceAll("</?code>", "`").strip();
        return plain.endsWith(".") ? plain : plain + ".";
    }

    /** Whether TLS is enabled. */
    public boolean isOn() {
        return isOn(config);
    }

    private static boolean isOn(AbstractConfig config) {
        return DECIDING.stream().anyMatch(option -> config.values().get(option) != null);
    }

    /** The key store file; null if the keys are configured otherwise. */
    public String location() {
        return config.getString(KEYSTORE);
    }

    /** The configuration of an engine factory. */
    public Map<String, Object> settings() {
        Map<String, Object> settings = new HashMap<>();
        OF_KAFKA.keySet().forEach(option -> settings.put(option, config.values().get(option)));
        settings.put(CLIENT_AUTH, config.getString(CLIENT_AUTH));
        return settings;
    }

    /** A factory that has loaded its files. */
    public SslEngineFactory newEngineFactory() {
        Class<?> configured = config.getClass(ENGINE_FACTORY);
        SslEngineFactory factory = configured == null
                ? new DefaultSslEngineFactory()
                : Utils.newInstance(configured.asSubclass(SslEngineFactory.class));
        factory.configure(settings());
        return factory;
    }
}
