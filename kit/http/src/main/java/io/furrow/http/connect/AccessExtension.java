package io.furrow.http.connect;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.connect.rest.ConnectRestExtension;
import org.apache.kafka.connect.rest.ConnectRestExtensionContext;

import io.furrow.http.AccessRule;
import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;

/**
 * Applies {@link AccessRule} to a worker's REST API; enabled by {@code rest.extension.classes}. The addresses of {@code
 * listeners} and {@code rest.advertised.host.name}, which other workers use, are always allowed; {@code GET /health} is
 * open to probes. Connect applies extensions to {@code listeners} only, not to separate {@code admin.listeners}.
 */
public final class AccessExtension implements ConnectRestExtension {
    /** List of further hosts of the worker. */
    public static final String ALLOWED_HOSTS = "furrow.http.allowed.hosts";
    /** List of origins of pages that may use the worker. */
    public static final String ALLOWED_ORIGINS = "furrow.http.allowed.origins";

    private static final OptionNames NAMES = new OptionNames(ALLOWED_HOSTS, ALLOWED_ORIGINS);
    private static final String LISTENERS = "listeners";
    private static final String ADVERTISED = "rest.advertised.host.name";
    private static final String BUILD = "/furrow-http-access.properties";
    private static final ConfigDef OPTIONS = new ConfigDef()
            .define(
                    ALLOWED_HOSTS,
                    Type.LIST,
                    "",
                    Importance.MEDIUM,
                    "Hosts by which this worker's REST API is reached, beside loopback, the listeners and the advertised host.")
            .define(
                    ALLOWED_ORIGINS,
                    Type.LIST,
                    "",
                    Importance.MEDIUM,
                    "Origins of the pages that may use this worker's REST API, beside its own. Leave"
                            + " access.control.allow.origin empty beside it.")
            .define(LISTENERS, Type.LIST, "http://:8083", Importance.HIGH, "Of Connect itself.")
            .define(ADVERTISED, Type.STRING, null, Importance.LOW, "Of Connect itself.");

    private AccessRule rule;

    /** Called by the worker. */
    public AccessExtension() {}

    /** @throws ConfigException if a host or origin is invalid */
    @Override
    public void configure(Map<String, ?> settings) {
        AbstractConfig config = new AbstractConfig(OPTIONS, settings, false);
        rule = AccessRule.allowing(allowed(config), NAMES)
                .servedAs(ownHosts(config).toArray(String[]::new))
                .withProbes("/health");
    }

    private static AllowedNames allowed(AbstractConfig config) {
        try {
            return AllowedNames.of(NAMES, config.getList(ALLOWED_HOSTS), config.getList(ALLOWED_ORIGINS));
        } catch (IllegalArgumentException e) {
            throw new ConfigException(e.getMessage());
        }
    }

    private static List<String> ownHosts(AbstractConfig config) {
        List<String> hosts = new ArrayList<>();
        config.getList(LISTENERS)
                .forEach(listener -> hosts.add(URI.create(listener).getHost()));
        hosts.add(config.getString(ADVERTISED));
        return hosts;
    }

    @Override
    public void register(ConnectRestExtensionContext context) {
        context.configurable().register(new AccessFilter(rule));
    }

    @Override
    public String version() {
        try (InputStream in = AccessExtension.class.getResourceAsStream(BUILD)) {
            Properties build = new Properties();
            build.load(in);
            return build.getProperty("version");
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + BUILD, e);
        }
    }

    @Override
    public void close() {
        // no resources
    }
}
