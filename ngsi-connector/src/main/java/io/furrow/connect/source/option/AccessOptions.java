package io.furrow.connect.source.option;

import java.util.List;
import java.util.function.Consumer;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;
import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;

/** Options for the host names under which the source is reached and the web origins that may use it. */
public record AccessOptions(AbstractConfig config) {
    static final String ALLOWED_HOSTS = "allowed.hosts";
    static final String ALLOWED_ORIGINS = "allowed.origins";
    public static final OptionNames NAMES = new OptionNames(ALLOWED_HOSTS, ALLOWED_ORIGINS);

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Access");
        group.list(
                ALLOWED_HOSTS,
                "",
                each(AllowedNames::requireHost, "names or addresses without scheme and port"),
                "Hosts",
                "Host names under which senders reach the source, besides loopback, " + ListeningOptions.HOST
                        + ", the address that a"
                        + " connection arrives at, and the host of " + SubscriptionOptions.PUBLIC_URL
                        + ". A request under another host is answered 403, counted and not stored: list the hosts that"
                        + " manually created subscriptions send to.");
        group.low()
                .list(
                        ALLOWED_ORIGINS,
                        "",
                        each(AllowedNames::requireOrigin, "scheme://host or scheme://host:port"),
                        "Origins",
                        "Origins of web pages that may send to the source and read its pages. Context brokers send no origin.");
    }

    private static ConfigDef.Validator each(Consumer<String> check, String expected) {
        return LambdaValidator.with(
                (name, value) -> {
                    for (Object one : (List<?>) value) {
                        try {
                            check.accept((String) one);
                        } catch (IllegalArgumentException e) {
                            throw new ConfigException(name, one, e.getMessage());
                        }
                    }
                },
                () -> expected);
    }

    public AllowedNames allowed() {
        return new AllowedNames(config.getList(ALLOWED_HOSTS), config.getList(ALLOWED_ORIGINS));
    }
}
