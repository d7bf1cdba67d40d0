package io.furrow.dashboard.status;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;

import io.prometheus.metrics.expositionformats.PrometheusTextFormatWriter;
import io.prometheus.metrics.model.snapshots.CounterSnapshot;
import io.prometheus.metrics.model.snapshots.CounterSnapshot.CounterDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot.GaugeDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.Labels;
import io.prometheus.metrics.model.snapshots.MetricSnapshots;

import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.proxy.TopicStreams;

/** What streams are and did, in the text format of Prometheus. Neither topics nor users are labels: the page needs no token. */
final class StreamMetrics {
    static final String CONTENT_TYPE = PrometheusTextFormatWriter.CONTENT_TYPE;

    private static final String REASON = "reason";

    private final TopicStreams streams;
    private final PrometheusTextFormatWriter writer =
            PrometheusTextFormatWriter.builder().build();

    StreamMetrics(TopicStreams streams) {
        this.streams = streams;
    }

    byte[] page() {
        StreamCounters counters = streams.counters();
        int sockets = streams.sockets();
        CounterSnapshot.Builder closed = counter("streams_closed", "Streams that are over, by why.");
        for (StreamCounters.Closing reason : StreamCounters.Closing.values()) {
            closed.dataPoint(point(Labels.of(REASON, reason.code()), counters.streamsClosed(reason)));
        }
        CounterSnapshot.Builder refused = counter(
                "refused",
                "Requests, sockets and messages that were refused, by the error that they were answered with.");
        counters.refusals().forEach((error, count) -> refused.dataPoint(point(Labels.of(REASON, error), count.sum())));
        return write(MetricSnapshots.builder()
                .metricSnapshot(gauge("streams", "Open streams.")
                        .dataPoint(value(Labels.of("kind", "socket"), sockets))
                        .dataPoint(value(Labels.of("kind", "events"), Math.max(0, streams.open() - sockets)))
                        .build())
                .metricSnapshot(gauge("topics", "Topics that are read, each by one consumer.")
                        .dataPoint(value(Labels.EMPTY, streams.topics()))
                        .build())
                .metricSnapshot(gauge("tickets", "Paths of sockets that wait to be opened.")
                        .dataPoint(value(Labels.EMPTY, streams.unusedTickets()))
                        .build())
                .metricSnapshot(single("streams_opened", "Streams that were opened.", counters.streamsOpened()))
                .metricSnapshot(closed.build())
                .metricSnapshot(single("records_read", "Records of topics that were read.", counters.recordsRead()))
                .metricSnapshot(single(
                        "records_sent",
                        "Records that were sent, counted once for each stream.",
                        counters.recordsSent()))
                .metricSnapshot(single(
                        "records_merged",
                        "Records that a newer one took the place of before they were sent.",
                        counters.recordsMerged()))
                .metricSnapshot(
                        single("messages_written", "Messages of sockets that Kafka has.", counters.messagesWritten()))
                .metricSnapshot(refused.build())
                .build());
    }

    private static CounterSnapshot single(String name, String help, long value) {
        return counter(name, help).dataPoint(point(Labels.EMPTY, value)).build();
    }

    private static CounterSnapshot.Builder counter(String name, String help) {
        return CounterSnapshot.builder().name("furrow_dashboard_" + name).help(help);
    }

    private static GaugeSnapshot.Builder gauge(String name, String help) {
        return GaugeSnapshot.builder().name("furrow_dashboard_" + name).help(help);
    }

    private static GaugeDataPointSnapshot value(Labels labels, double value) {
        return GaugeDataPointSnapshot.builder().labels(labels).value(value).build();
    }

    private static CounterDataPointSnapshot point(Labels labels, double value) {
        return CounterDataPointSnapshot.builder().labels(labels).value(value).build();
    }

    private byte[] write(MetricSnapshots metrics) {
        ByteArrayOutputStream page = new ByteArrayOutputStream();
        try {
            writer.write(page, metrics);
        } catch (IOException e) {
            throw new UncheckedIOException("memory cannot fail", e);
        }
        return page.toByteArray();
    }
}
