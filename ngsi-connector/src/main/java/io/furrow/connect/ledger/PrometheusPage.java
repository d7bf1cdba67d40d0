package io.furrow.connect.ledger;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;

import io.prometheus.metrics.expositionformats.PrometheusTextFormatWriter;
import io.prometheus.metrics.model.snapshots.CounterSnapshot;
import io.prometheus.metrics.model.snapshots.CounterSnapshot.CounterDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot.GaugeDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.Labels;
import io.prometheus.metrics.model.snapshots.MetricMetadata;
import io.prometheus.metrics.model.snapshots.MetricSnapshot;
import io.prometheus.metrics.model.snapshots.MetricSnapshots;

import static java.util.List.of;

/**
 * Writes metrics of a source task in the text format of Prometheus:
 * {@code furrow_ngsi_source_received_total{connector="…",task="0"} 7}, gauges without {@code _total}.
 */
public final class PrometheusPage {
    public static final String CONTENT_TYPE = PrometheusTextFormatWriter.CONTENT_TYPE;

    private final Metrics metrics;
    private final Labels labels;

    /** @param task index of the task that owns the metrics */
    public PrometheusPage(Metrics metrics, String connector, int task) {
        this.metrics = metrics;
        this.labels = Labels.of("connector", connector, "task", Integer.toString(task));
    }

    /** The current values. */
    public byte[] write() {
        ByteArrayOutputStream page = new ByteArrayOutputStream();
        try {
            PrometheusTextFormatWriter.builder()
                    .build()
                    .write(
                            page,
                            new MetricSnapshots(
                                    metrics.all().stream().map(this::snapshot).toList()));
        } catch (IOException e) {
            throw new UncheckedIOException("memory cannot fail", e);
        }
        return page.toByteArray();
    }

    private MetricSnapshot snapshot(Metric metric) {
        MetricMetadata metadata = new MetricMetadata("furrow_ngsi_source_" + metric.name('_'), metric.help());
        return metric.isCounter()
                ? new CounterSnapshot(metadata, of(new CounterDataPointSnapshot(metric.now(), labels, null, 0)))
                : new GaugeSnapshot(metadata, of(new GaugeDataPointSnapshot(metric.now(), labels, null)));
    }
}
