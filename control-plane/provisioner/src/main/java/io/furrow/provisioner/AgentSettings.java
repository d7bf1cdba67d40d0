package io.furrow.provisioner;

import java.net.URI;
import java.time.Duration;

import io.furrow.model.file.AccessToken;

/**
 * Settings of the IoT Agent at which devices are provisioned.
 *
 * @param base of its provisioning interface, as in {@code http://127.0.0.1:4041}
 * @param resource of the service groups: the agent's default resource ({@code IOTA_DEFAULT_RESOURCE}), because the
 *     agent looks up the device of a measure only in groups of that resource. Empty, or a path that begins with a slash
 * @param interval between reconciliations of the agent's groups and devices with the desired ones; at least a second
 * @param token of each request
 */
public record AgentSettings(URI base, String resource, Duration interval, AccessToken token) {
    public static final String DEFAULT_RESOURCE = "/iot/json";
    /** Restores lost registrations within a minute, even if one or two attempts fail. */
    public static final Duration DEFAULT_INTERVAL = Duration.ofSeconds(30);

    private static final Duration MIN_INTERVAL = Duration.ofSeconds(1);

    /** @throws IllegalArgumentException if a setting is invalid; the message names it and the allowed values */
    public AgentSettings {
        if (!resource.matches("|/[^\\s<>\"'=;()?#&]*")) {
            throw new IllegalArgumentException(
                    "the resource of the IoT Agent must be empty or begin with '/', as '/iot/json', not '" + resource
                            + "'");
        }
        if (interval.compareTo(MIN_INTERVAL) < 0) {
            throw new IllegalArgumentException(
                    "the interval of requests to the IoT Agent must be at least a second, not " + interval);
        }
    }

    /** Returns settings with the default resource and interval, without a token. */
    public static AgentSettings at(URI base) {
        return new AgentSettings(base, DEFAULT_RESOURCE, DEFAULT_INTERVAL, AccessToken.NONE);
    }

    public AgentSettings withResource(String other) {
        return new AgentSettings(base, other, interval, token);
    }

    public AgentSettings withInterval(Duration other) {
        return new AgentSettings(base, resource, other, token);
    }

    public AgentSettings withToken(AccessToken other) {
        return new AgentSettings(base, resource, interval, other);
    }
}
