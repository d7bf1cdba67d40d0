package io.furrow.dashboard;

import java.net.URI;
import java.util.Properties;

import io.furrow.dashboard.auth.TrustedProxy;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.dashboard.page.PageSettings;
import io.furrow.http.AllowedNames;
import io.furrow.model.topic.TopicRules;

/**
 * Settings of the dashboard.
 *
 * @param host address to listen on
 * @param port 0 for a free one
 * @param client settings of Kafka clients
 * @param controlPlane base URL of the control plane's REST API; stored without a slash at its end
 * @param proxy that signs users in; null if each user has a token
 */
public record DashboardSettings(
        String host,
        int port,
        Properties client,
        URI controlPlane,
        TopicRules rules,
        StreamLimits limits,
        AllowedNames allowed,
        PageSettings page,
        TrustedProxy proxy) {
    public DashboardSettings {
        controlPlane = URI.create(controlPlane.toString().replaceAll("/+$", ""));
    }

    /** Listens on loopback, with the default topics and limits. */
    public static DashboardSettings of(int port, Properties client, URI controlPlane) {
        return new DashboardSettings(
                "127.0.0.1",
                port,
                client,
                controlPlane,
                TopicRules.DEFAULT,
                StreamLimits.DEFAULT,
                AllowedNames.NONE,
                PageSettings.DEFAULT,
                null);
    }

    public DashboardSettings withHost(String name) {
        return new DashboardSettings(name, port, client, controlPlane, rules, limits, allowed, page, proxy);
    }

    public DashboardSettings withRules(TopicRules topics) {
        return new DashboardSettings(host, port, client, controlPlane, topics, limits, allowed, page, proxy);
    }

    public DashboardSettings withLimits(StreamLimits newLimits) {
        return new DashboardSettings(host, port, client, controlPlane, rules, newLimits, allowed, page, proxy);
    }

    public DashboardSettings withAllowed(AllowedNames names) {
        return new DashboardSettings(host, port, client, controlPlane, rules, limits, names, page, proxy);
    }

    public DashboardSettings withPage(PageSettings settings) {
        return new DashboardSettings(host, port, client, controlPlane, rules, limits, allowed, settings, proxy);
    }

    public DashboardSettings withProxy(TrustedProxy trusted) {
        return new DashboardSettings(host, port, client, controlPlane, rules, limits, allowed, page, trusted);
    }
}
