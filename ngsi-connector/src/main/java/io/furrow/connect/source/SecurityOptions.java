package io.furrow.connect.source;

import java.util.List;
import java.util.Set;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.types.Password;

import io.furrow.connect.Validators;

import static java.util.regex.Pattern.compile;

/** Who may send notifications. */
record SecurityOptions(AbstractConfig config) {
    static final String SECRET_HEADER = "secret.header";
    static final String SECRET = "secret";
    static final String SECRET_PREVIOUS = "secret.previous";
    static final String ALLOWED_TENANTS = "allowed.tenants";

    /** Stands for a notification without a tenant; no tenant can be called so. */
    static final String NO_TENANT = "-";

    SecurityOptions {
        if (config.getPassword(SECRET).value().isEmpty()
                && !config.getPassword(SECRET_PREVIOUS).value().isEmpty()) {
            throw new ConfigException(SECRET_PREVIOUS, Password.HIDDEN, "needs " + SECRET + " beside it");
        }
    }

    static void define(ConfigDef options) {
        String group = "Security";
        options.define(
                SECRET_HEADER,
                Type.STRING,
                "X-Furrow-Secret",
                Validators.matching(compile("[A-Za-z0-9-]{1,64}"), "the name of an HTTP header"),
                Importance.MEDIUM,
                "Header whose value must be the secret. With Authorization the secret is the whole value, Bearer included.",
                group,
                1,
                Width.MEDIUM,
                "Header");
        secret(
                options,
                SECRET,
                "Secret that each notification must carry, else it is answered 401. Empty for none.",
                2);
        secret(options, SECRET_PREVIOUS, "Second secret that is taken as well, while senders change to the first.", 3);
        options.define(
                ALLOWED_TENANTS,
                Type.LIST,
                "",
                ConfigDef.LambdaValidator.with((name, value) -> {}, () -> "names separated by commas"),
                Importance.MEDIUM,
                "Tenants (fiware-service) whose notifications are taken, " + NO_TENANT
                        + " for those without one; others are"
                        + " answered 403, counted, and kept nowhere. Empty for all.",
                group,
                4,
                Width.LONG,
                "Tenants");
    }

    private static void secret(ConfigDef options, String name, String documentation, int order) {
        options.define(
                name,
                Type.PASSWORD,
                "",
                ConfigDef.LambdaValidator.with(SecurityOptions::requireHeaderValue, () -> "printable ASCII"),
                Importance.HIGH,
                documentation,
                "Security",
                order,
                Width.LONG,
                name.equals(SECRET) ? "Secret" : "Previous secret");
    }

    private static void requireHeaderValue(String name, Object value) {
        String text = ((Password) value).value();
        if (!text.chars().allMatch(sign -> sign >= ' ' && sign <= '~') || !text.equals(text.strip())) {
            throw new ConfigException(name, Password.HIDDEN, "printable ASCII without spaces around it is expected");
        }
    }

    String secretHeader() {
        return config.getString(SECRET_HEADER);
    }

    /** Those that are taken; empty where none is asked for. */
    List<Password> secrets() {
        return Stream.of(SECRET, SECRET_PREVIOUS)
                .map(config::getPassword)
                .filter(secret -> !secret.value().isEmpty())
                .toList();
    }

    /** In lower case, the empty text for no tenant; empty where all are allowed. */
    Set<String> allowedTenants() {
        return config.getList(ALLOWED_TENANTS).stream()
                .map(tenant -> tenant.equals(NO_TENANT) ? "" : tenant.toLowerCase(java.util.Locale.ROOT))
                .collect(Collectors.toUnmodifiableSet());
    }
}
