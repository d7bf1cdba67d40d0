package io.furrow.dashboard;

import java.net.URI;
import java.util.Properties;

import io.furrow.dashboard.auth.TrustedProxy;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.dashboard.feed.TopicRules;
import io.furrow.dashboard.page.PageSettings;
import io.furrow.http.AllowedNames;

/**
 * Where the dashboard listens, and what it stands in front of.
 *
 * @param port 0 for a free one
 * @param client properties of Kafka clients
 * @param controlPlane base of its REST API
 * @param proxy that signs users in; null if each has a token
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
    /** On loopback, with the usual topics and limits. */
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

    public DashboardSettings withLimits(StreamLimits of) {
        return new DashboardSettings(host, port, client, controlPlane, rules, of, allowed, page, proxy);
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
