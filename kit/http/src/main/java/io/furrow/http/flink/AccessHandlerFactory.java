package io.furrow.http.flink;

import java.util.Map;
import java.util.Optional;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.RestOptions;
import org.apache.flink.runtime.io.network.netty.InboundChannelHandlerFactory;
import org.apache.flink.shaded.netty4.io.netty.channel.ChannelHandler;
import org.apache.flink.util.ConfigurationException;

import io.furrow.http.AccessRule;
import io.furrow.http.AllowedNames;
import io.furrow.http.OptionNames;

/** Applies {@link AccessRule} to Flink's REST API and web UI. Flink discovers it when the jar is in {@code lib/}. */
public final class AccessHandlerFactory implements InboundChannelHandlerFactory {
    private static final OptionNames NAMES =
            new OptionNames(AccessOptions.ALLOWED_HOSTS.key(), AccessOptions.ALLOWED_ORIGINS.key());

    /** Called by Flink. */
    public AccessHandlerFactory() {}

    /** Runs before other handlers, so that rejected requests do not reach them. */
    @Override
    public int priority() {
        return Integer.MAX_VALUE;
    }

    /** @throws ConfigurationException if a host or origin is invalid; Flink then closes each connection */
    @Override
    public Optional<ChannelHandler> createHandler(Configuration configuration, Map<String, String> responseHeaders)
            throws ConfigurationException {
        try {
            AllowedNames allowed = AllowedNames.of(
                    NAMES,
                    configuration.get(AccessOptions.ALLOWED_HOSTS),
                    configuration.get(AccessOptions.ALLOWED_ORIGINS));
            AccessRule rule = AccessRule.allowing(allowed, NAMES)
                    .servedAs(configuration.get(RestOptions.ADDRESS), configuration.get(RestOptions.BIND_ADDRESS));
            return Optional.of(new AccessChannelHandler(rule, configuration.get(AccessOptions.READ_ONLY)));
        } catch (IllegalArgumentException e) {
            throw new ConfigurationException(e.getMessage(), e);
        }
    }
}
