package io.furrow.connect.source;

import java.nio.file.Path;
import java.util.Optional;
import java.util.function.Predicate;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.ValidString;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.types.Password;

import io.furrow.connect.Recommendations;

/** Whether notifications come over TLS, and with which keys. */
record TlsOptions(AbstractConfig config) {
    static final String KEYSTORE = "tls.keystore.location";
    static final String KEYSTORE_TYPE = "tls.keystore.type";
    static final String KEYSTORE_PASSWORD = "tls.keystore.password";
    static final String TRUSTSTORE = "tls.truststore.location";
    static final String TRUSTSTORE_TYPE = "tls.truststore.type";
    static final String TRUSTSTORE_PASSWORD = "tls.truststore.password";
    static final String CLIENT_AUTH = "tls.client.auth";

    private static final String GROUP = "TLS";
    private static final Predicate<String> IN_USE = path -> !path.isEmpty();

    /** A file of keys or certificates. */
    record Store(Path location, String type, Password password) {}

    TlsOptions {
        if (!config.getString(CLIENT_AUTH).equals("none")
                && config.getString(TRUSTSTORE).isEmpty()) {
            throw new ConfigException(
                    CLIENT_AUTH, config.getString(CLIENT_AUTH), "needs " + TRUSTSTORE + ": whose clients are trusted?");
        }
        if (!config.getString(TRUSTSTORE).isEmpty()
                && config.getString(KEYSTORE).isEmpty()) {
            throw new ConfigException(TRUSTSTORE, config.getString(TRUSTSTORE), "needs " + KEYSTORE + " beside it");
        }
    }

    static void define(ConfigDef options) {
        location(
                options,
                KEYSTORE,
                1,
                "File with the server's key and certificates; with it, notifications come over TLS.");
        type(options, KEYSTORE_TYPE, 2, "Its format: PKCS12, JKS, or PEM with an unencrypted PKCS 8 key.");
        password(options, KEYSTORE_PASSWORD, 3, "Its password, unless it is PEM.");
        location(options, TRUSTSTORE, 4, "File with the certificates of whom clients' certificates must come from.");
        type(options, TRUSTSTORE_TYPE, 5, "Its format: PKCS12, JKS or PEM.");
        password(options, TRUSTSTORE_PASSWORD, 6, "Its password, unless it is PEM.");
        options.define(
                CLIENT_AUTH,
                Type.STRING,
                "none",
                ValidString.in("none", "requested", "required"),
                Importance.LOW,
                "Whether clients show a certificate: none, requested or required.",
                GROUP,
                7,
                Width.SHORT,
                "Client certificates",
                Recommendations.shownIf(KEYSTORE, IN_USE, "none", "requested", "required"));
    }

    private static void location(ConfigDef options, String name, int order, String documentation) {
        options.define(
                name,
                Type.STRING,
                "",
                LambdaValidator.with((option, value) -> {}, () -> "a path, or empty for none"),
                Importance.MEDIUM,
                documentation,
                GROUP,
                order,
                Width.LONG,
                name.equals(KEYSTORE) ? "Key store" : "Trust store",
                name.equals(KEYSTORE) ? Recommendations.values() : Recommendations.shownIf(KEYSTORE, IN_USE));
    }

    private static void type(ConfigDef options, String name, int order, String documentation) {
        options.define(
                name,
                Type.STRING,
                "PKCS12",
                ValidString.in("PKCS12", "JKS", "PEM"),
                Importance.LOW,
                documentation,
                GROUP,
                order,
                Width.SHORT,
                name.equals(KEYSTORE_TYPE) ? "Key store type" : "Trust store type",
                Recommendations.shownIf(
                        name.equals(KEYSTORE_TYPE) ? KEYSTORE : TRUSTSTORE, IN_USE, "PKCS12", "JKS", "PEM"));
    }

    private static void password(ConfigDef options, String name, int order, String documentation) {
        options.define(
                name,
                Type.PASSWORD,
                "",
                LambdaValidator.with((option, value) -> {}, () -> "any"),
                Importance.MEDIUM,
                documentation,
                GROUP,
                order,
                Width.MEDIUM,
                name.equals(KEYSTORE_PASSWORD) ? "Key store password" : "Trust store password",
                Recommendations.shownIf(name.equals(KEYSTORE_PASSWORD) ? KEYSTORE : TRUSTSTORE, IN_USE));
    }

    /** Empty where notifications come in plain text. */
    Optional<Store> keys() {
        return store(KEYSTORE, KEYSTORE_TYPE, KEYSTORE_PASSWORD);
    }

    Optional<Store> trusted() {
        return store(TRUSTSTORE, TRUSTSTORE_TYPE, TRUSTSTORE_PASSWORD);
    }

    String clientAuth() {
        return config.getString(CLIENT_AUTH);
    }

    private Optional<Store> store(String location, String type, String password) {
        String path = config.getString(location);
        return path.isEmpty()
                ? Optional.empty()
                : Optional.of(new Store(Path.of(path), config.getString(type), config.getPassword(password)));
    }
}
