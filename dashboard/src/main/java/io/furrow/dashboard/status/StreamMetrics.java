package io.furrow.dashboard.status;

import java.util.Arrays;
import java.util.Locale;
import java.util.stream.Stream;

import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.proxy.TopicStreams;
import io.furrow.http.prometheus.MetricsPage;
import io.furrow.http.prometheus.MetricsPage.Point;

/** Metrics of streams in Prometheus' text format. Topics and users are not labels, because the page needs no token. */
final class StreamMetrics {
    private static final String REASON = "reason";

    private StreamMetrics() {}

    static byte[] page(TopicStreams streams) {
        StreamCounters counters = streams.counters();
        int sockets = streams.sockets();
        MetricsPage page = new MetricsPage("furrow_dashboard_");
        page.gauge(
                "streams",
                "Open streams.",
                Stream.of(
                        new Point(sockets, "kind", "socket"),
                        new Point(Math.max(0, streams.open() - sockets), "kind", "events")));
        page.gauge(
                "topics",
                "Topics that are read, each by one consumer.",
                streams.feeds().size());
        page.gauge("tickets", "Paths of sockets that wait to be opened.", streams.unusedTickets());
        page.counter(
                "streams_closed",
                "Streams that are over, by why.",
                Arrays.stream(StreamCounters.Closing.values())
                        .map(reason -> new Point(counters.sum(reason), REASON, reason.code())));
        page.counter(
                "refused",
                "Requests, sockets and messages that were refused, by the error that they were answered with.",
                counters.rejections().entrySet().stream()
                        .map(each -> new Point(each.getValue().sum(), REASON, each.getKey())));
        for (StreamCounters.Count each : StreamCounters.Count.values()) {
            page.counter(each.name().toLowerCase(Locale.ROOT), each.help(), counters.sum(each));
        }
        return page.write();
    }
}
