package io.furrow.connect.source.option;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Validator;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;

/** Options for the host names under which the source is reached and the web origins that may use it. */
public record AccessOptions(AbstractConfig config) {
    static final String ALLOWED_HOSTS = "allowed.hosts";
    static final String ALLOWED_ORIGINS = "allowed.origins";
    public static final OptionNames NAMES = new OptionNames(ALLOWED_HOSTS, ALLOWED_ORIGINS);

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Access");
        Validator hosts = Validators.each(AllowedNames::requireHost, "names or addresses without scheme and port");
        group.list(ALLOWED_HOSTS, "", hosts, "Hosts")
                .help("Host names under which senders reach the source, besides loopback, " + ListeningOptions.HOST
                        + ", the address that a connection arrives at, and the host of "
                        + SubscriptionOptions.PUBLIC_URL + ". A request under another host is answered 403, counted and"
                        + " not stored: list the hosts that manually created subscriptions send to.");
        Validator origins = Validators.each(AllowedNames::requireOrigin, "scheme://host or scheme://host:port");
        group.low()
                .list(ALLOWED_ORIGINS, "", origins, "Origins")
                .help("Origins of web pages that may send to the source and read its pages. Context brokers send no"
                        + " origin.");
    }

    public AllowedNames allowed() {
        return new AllowedNames(config.getList(ALLOWED_HOSTS), config.getList(ALLOWED_ORIGINS));
    }
}
