package io.furrow.http.prometheus;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.stream.Stream;

import io.prometheus.metrics.expositionformats.PrometheusTextFormatWriter;
import io.prometheus.metrics.model.snapshots.CounterSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot;
import io.prometheus.metrics.model.snapshots.Labels;
import io.prometheus.metrics.model.snapshots.MetricSnapshots;

/** Composes a page of metrics in Prometheus' text format, sorted by name. */
public final class MetricsPage {
    public static final String CONTENT_TYPE = PrometheusTextFormatWriter.CONTENT_TYPE;

    private final String prefix;
    private final MetricSnapshots.Builder metrics = MetricSnapshots.builder();

    /** @param labels names and values in turn */
    public record Point(double value, String... labels) {}

    /** @param prefix prefix of all names */
    public MetricsPage(String prefix) {
        this.prefix = prefix;
    }

    public MetricsPage counter(String name, String help, double value) {
        return counter(name, help, Stream.of(new Point(value)));
    }

    public MetricsPage counter(String name, String help, Stream<Point> points) {
        CounterSnapshot.Builder counter =
                CounterSnapshot.builder().name(prefix + name).help(help);
        points.forEach(point -> counter.dataPoint(CounterSnapshot.CounterDataPointSnapshot.builder()
                .labels(Labels.of(point.labels()))
                .value(point.value())
                .build()));
        metrics.metricSnapshot(counter.build());
        return this;
    }

    public MetricsPage gauge(String name, String help, double value) {
        return gauge(name, help, Stream.of(new Point(value)));
    }

    public MetricsPage gauge(String name, String help, Stream<Point> points) {
        GaugeSnapshot.Builder gauge =
                GaugeSnapshot.builder().name(prefix + name).help(help);
        points.forEach(point -> gauge.dataPoint(GaugeSnapshot.GaugeDataPointSnapshot.builder()
                .labels(Labels.of(point.labels()))
                .value(point.value())
                .build()));
        metrics.metricSnapshot(gauge.build());
        return this;
    }

    public byte[] write() {
        ByteArrayOutputStream page = new ByteArrayOutputStream();
        try {
            PrometheusTextFormatWriter.builder().build().write(page, metrics.build());
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write to memory", e);
        }
        return page.toByteArray();
    }
}
