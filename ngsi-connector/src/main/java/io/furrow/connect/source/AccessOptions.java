package io.furrow.connect.source;

import java.util.List;
import java.util.function.Consumer;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;

/** By which names the source is reached, and from which pages. */
record AccessOptions(AbstractConfig config) {
    static final String ALLOWED_HOSTS = "allowed.hosts";
    static final String ALLOWED_ORIGINS = "allowed.origins";
    static final OptionNames NAMES = new OptionNames(ALLOWED_HOSTS, ALLOWED_ORIGINS);

    private static final String GROUP = "Access";

    static void define(ConfigDef options) {
        options.define(
                ALLOWED_HOSTS,
                Type.LIST,
                "",
                each(AllowedNames::requireHost, "names or addresses without scheme and port"),
                Importance.MEDIUM,
                "Hosts by which senders reach the source, beside loopback, " + ListeningOptions.HOST
                        + ", the address that a"
                        + " connection arrives at, and the host of " + SubscriptionOptions.PUBLIC_URL
                        + ". A request under another host is answered 403, counted, and kept nowhere: name here what"
                        + " subscriptions made by hand send to.",
                GROUP,
                1,
                Width.LONG,
                "Hosts");
        options.define(
                ALLOWED_ORIGINS,
                Type.LIST,
                "",
                each(AllowedNames::requireOrigin, "scheme://host or scheme://host:port"),
                Importance.LOW,
                "Origins of web pages that may send to the source and read its pages. Context brokers send no origin.",
                GROUP,
                2,
                Width.LONG,
                "Origins");
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

    AllowedNames allowed() {
        return new AllowedNames(config.getList(ALLOWED_HOSTS), config.getList(ALLOWED_ORIGINS));
    }
}
