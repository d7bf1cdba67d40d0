package io.furrow.provisioner;

import java.net.URI;
import java.time.Duration;

import io.furrow.model.file.AccessToken;

/**
 * The IoT Agent at which devices are provisioned.
 *
 * @param base of its provisioning interface, as in {@code http://127.0.0.1:4041}
 * @param resource of the service groups, the same as the agent's default resource ({@code IOTA_DEFAULT_RESOURCE}): the agent finds the
 *     device behind a measure through a group of that resource only. Empty, or a path that begins with a slash
 * @param interval after which groups and devices at the agent are compared again with the desired ones; at least a second
 * @param token of each request
 */
public record AgentSettings(URI base, String resource, Duration interval, AccessToken token) {
    public static final String DEFAULT_RESOURCE = "/iot/json";
    /** With a failure or two in between, what the agent has lost is back within a minute. */
    public static final Duration DEFAULT_INTERVAL = Duration.ofSeconds(30);

    private static final Duration MIN_INTERVAL = Duration.ofSeconds(1);

    /** @throws IllegalArgumentException naming the setting and what it may be */
    public AgentSettings {
        if (!resource.matches("|/[^\\s<>\"'=;()?#&]*")) {
            throw new IllegalArgumentException(
                    "the resource of the IoT Agent must be empty or begin with '/', as '/iot/json', not '" + resource
                            + "'");
        }
        if (interval.compareTo(MIN_INTERVAL) < 0) {
            throw new IllegalArgumentException(
                    "the IoT Agent must be asked at intervals of at least a second, not " + interval);
        }
    }

    /** With the default resource and interval, without a token. */
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
