package io.furrow.connect.source;

import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.ConfigKey;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.ValidString;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.SslConfigs;
import org.apache.kafka.common.security.auth.SslEngineFactory;
import org.apache.kafka.common.security.ssl.DefaultSslEngineFactory;
import org.apache.kafka.common.utils.Utils;

import io.furrow.connect.Recommendations;

/**
 * Whether notifications come over TLS, and with which keys: the options that a Kafka broker has for its listeners, defined and
 * understood by Kafka's own classes.
 */
record TlsOptions(AbstractConfig config) {
    static final String KEYSTORE = SslConfigs.SSL_KEYSTORE_LOCATION_CONFIG;
    static final String KEY = SslConfigs.SSL_KEYSTORE_KEY_CONFIG;
    static final String TRUSTSTORE = SslConfigs.SSL_TRUSTSTORE_LOCATION_CONFIG;
    static final String TRUSTED = SslConfigs.SSL_TRUSTSTORE_CERTIFICATES_CONFIG;
    static final String ENGINE_FACTORY = SslConfigs.SSL_ENGINE_FACTORY_CLASS_CONFIG;
    /** Kafka defines it for brokers, in a class that is not public. */
    static final String CLIENT_AUTH = "ssl.client.auth";

    private static final String GROUP = "TLS";
    private static final String NO_CLIENT_AUTH = "none";
    private static final String FORMER_PREFIX = "tls.";

    private static final String TURNS_ON =
            " With it notifications come over TLS; a file that has changed is taken up without a restart.";

    /** Any of these turns TLS on. */
    private static final Set<String> DECIDING =
            Set.of(KEYSTORE, KEY, SslConfigs.SSL_KEYSTORE_CERTIFICATE_CHAIN_CONFIG, ENGINE_FACTORY);
    /** Useless without one of those. */
    private static final List<String> USELESS_ALONE = List.of(
            SslConfigs.SSL_KEYSTORE_PASSWORD_CONFIG,
            SslConfigs.SSL_KEY_PASSWORD_CONFIG,
            TRUSTSTORE,
            SslConfigs.SSL_TRUSTSTORE_PASSWORD_CONFIG,
            TRUSTED);

    private static final Map<String, String> LABELS = labels();
    private static final ConfigDef.Validator ANY = LambdaValidator.with((name, value) -> {}, () -> "any");

    TlsOptions {
        refuseFormerNames(config);
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
                    "needs " + TRUSTSTORE + " or " + TRUSTED + ": whose clients are trusted?");
        }
    }

    private static void refuseFormerNames(AbstractConfig config) {
        config.originals().keySet().stream()
                .filter(name -> name.startsWith(FORMER_PREFIX))
                .sorted()
                .findFirst()
                .ifPresent(former -> {
                    String name = "ssl." + former.substring(FORMER_PREFIX.length());
                    String known = config.values().containsKey(name) ? name : KEYSTORE;
                    throw new ConfigException(known, null, former + " is unknown; the option is called " + known);
                });
    }

    private static boolean trustsSomebody(AbstractConfig config) {
        return config.values().get(TRUSTSTORE) != null
                || config.values().get(TRUSTED) != null
                || config.values().get(ENGINE_FACTORY) != null;
    }

    static void define(ConfigDef options) {
        Map<String, ConfigKey> ofKafka = new ConfigDef().withClientSslSupport().configKeys();
        int order = 0;
        for (Map.Entry<String, String> option : LABELS.entrySet()) {
            ConfigKey key = ofKafka.get(option.getKey());
            options.define(
                    key.name,
                    key.type,
                    key.defaultValue,
                    key.validator == null ? ANY : key.validator,
                    key.importance,
                    inMarkdown(key.documentation) + (key.name.equals(KEYSTORE) ? TURNS_ON : ""),
                    GROUP,
                    ++order,
                    Width.LONG,
                    option.getValue());
        }
        options.define(
                CLIENT_AUTH,
                Type.STRING,
                NO_CLIENT_AUTH,
                ValidString.in("required", "requested", NO_CLIENT_AUTH),
                Importance.MEDIUM,
                "Whether clients show a certificate that the trust store vouches for: required, requested (one that is shown must"
                        + " be good) or none.",
                GROUP,
                ++order,
                Width.SHORT,
                "Client certificates",
                Recommendations.values("required", "requested", NO_CLIENT_AUTH));
    }

    /** Kafka writes for web pages. */
    private static String inMarkdown(String documentation) {
        String plain = documentation.replaceAll("</?code>", "`").strip();
        return plain.endsWith(".") ? plain : plain + ".";
    }

    private static Map<String, String> labels() {
        Map<String, String> labels = new LinkedHashMap<>();
        labels.put(KEYSTORE, "Key store");
        labels.put(SslConfigs.SSL_KEYSTORE_TYPE_CONFIG, "Key store type");
        labels.put(SslConfigs.SSL_KEYSTORE_PASSWORD_CONFIG, "Key store password");
        labels.put(KEY, "Key");
        labels.put(SslConfigs.SSL_KEYSTORE_CERTIFICATE_CHAIN_CONFIG, "Certificate chain");
        labels.put(SslConfigs.SSL_KEY_PASSWORD_CONFIG, "Key password");
        labels.put(TRUSTSTORE, "Trust store");
        labels.put(SslConfigs.SSL_TRUSTSTORE_TYPE_CONFIG, "Trust store type");
        labels.put(SslConfigs.SSL_TRUSTSTORE_PASSWORD_CONFIG, "Trust store password");
        labels.put(TRUSTED, "Trusted certificates");
        labels.put(SslConfigs.SSL_ENABLED_PROTOCOLS_CONFIG, "Protocols");
        labels.put(SslConfigs.SSL_CIPHER_SUITES_CONFIG, "Cipher suites");
        labels.put(SslConfigs.SSL_PROTOCOL_CONFIG, "Protocol of the context");
        labels.put(SslConfigs.SSL_PROVIDER_CONFIG, "Provider");
        labels.put(SslConfigs.SSL_KEYMANAGER_ALGORITHM_CONFIG, "Key manager");
        labels.put(SslConfigs.SSL_TRUSTMANAGER_ALGORITHM_CONFIG, "Trust manager");
        labels.put(SslConfigs.SSL_SECURE_RANDOM_IMPLEMENTATION_CONFIG, "Random numbers");
        labels.put(ENGINE_FACTORY, "Engine factory");
        return labels;
    }

    /** Whether notifications come over TLS. */
    boolean isOn() {
        return isOn(config);
    }

    private static boolean isOn(AbstractConfig config) {
        return DECIDING.stream().anyMatch(option -> config.values().get(option) != null);
    }

    /** The file of the keys; null where they are given otherwise. */
    String location() {
        return config.getString(KEYSTORE);
    }

    /** What an engine factory is configured with. */
    Map<String, Object> settings() {
        Map<String, Object> settings = new HashMap<>();
        LABELS.keySet().forEach(option -> settings.put(option, config.values().get(option)));
        settings.put(CLIENT_AUTH, config.getString(CLIENT_AUTH));
        return settings;
    }

    /** One that has read its files. */
    SslEngineFactory newEngineFactory() {
        Class<?> wanted = config.getClass(ENGINE_FACTORY);
        SslEngineFactory factory = wanted == null
                ? new DefaultSslEngineFactory()
                : Utils.newInstance(wanted.asSubclass(SslEngineFactory.class));
        factory.configure(settings());
        return factory;
    }
}
