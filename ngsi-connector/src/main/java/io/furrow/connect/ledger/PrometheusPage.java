package io.furrow.connect.ledger;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Locale;

import io.prometheus.metrics.expositionformats.PrometheusTextFormatWriter;
import io.prometheus.metrics.model.snapshots.CounterSnapshot;
import io.prometheus.metrics.model.snapshots.CounterSnapshot.CounterDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot.GaugeDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.Labels;
import io.prometheus.metrics.model.snapshots.MetricSnapshots;

/**
 * The ledger in the text format of Prometheus: {@code furrow_ngsi_source_received_total{connector="…",task="0"} 7}, a gauge
 * without {@code _total}.
 */
public final class PrometheusPage {
    public static final String CONTENT_TYPE = PrometheusTextFormatWriter.CONTENT_TYPE;

    private static final String PREFIX = "furrow_ngsi_source_";

    private final Ledger ledger;
    private final Labels labels;
    private final PrometheusTextFormatWriter writer =
            PrometheusTextFormatWriter.builder().build();

    /** @param task which of the connector's tasks the ledger is of */
    public PrometheusPage(Ledger ledger, String connector, int task) {
        this.ledger = ledger;
        this.labels = Labels.of("connector", connector, "task", Integer.toString(task));
    }

    /** The numbers of now. */
    public byte[] write() {
        MetricSnapshots.Builder metrics = MetricSnapshots.builder();
        for (Counter counter : ledger.counters()) {
            metrics.metricSnapshot(CounterSnapshot.builder()
                    .name(PREFIX + snakeCase(counter.name()))
                    .help(counter.help())
                    .dataPoint(CounterDataPointSnapshot.builder()
                            .labels(labels)
                            .value(counter.sum())
                            .build())
                    .build());
        }
        for (Gauge gauge : ledger.gauges()) {
            metrics.metricSnapshot(GaugeSnapshot.builder()
                    .name(PREFIX + snakeCase(gauge.name()))
                    .help(gauge.help())
                    .dataPoint(GaugeDataPointSnapshot.builder()
                            .labels(labels)
                            .value(gauge.now().getAsLong())
                            .build())
                    .build());
        }
        ByteArrayOutputStream page = new ByteArrayOutputStream();
        try {
            writer.write(page, metrics.build());
        } catch (IOException e) {
            throw new UncheckedIOException("memory cannot fail", e);
        }
        return page.toByteArray();
    }

    private static String snakeCase(String camelCase) {
        return camelCase.replaceAll("([A-Z])", "_$1").toLowerCase(Locale.ROOT);
    }
}
