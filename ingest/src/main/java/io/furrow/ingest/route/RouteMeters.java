package io.furrow.ingest.route;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Histogram;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.runtime.metrics.DescriptiveStatisticsHistogram;

import io.furrow.model.event.HeaderNames;

/** Metrics of the events of one domain and mission. */
final class RouteMeters {
    /** The number of last events in a hop's statistics. */
    private static final int WINDOW = 1000;

    private final Counter routed;
    private final Counter late;
    private final Counter bytes;
    private final Histogram deviceToSource;
    private final Histogram sourceToIngest;

    RouteMeters(MetricGroup group) {
        routed = group.counter("routed");
        late = group.counter("late");
        bytes = group.counter("bytes");
        deviceToSource = group.histogram("lagDeviceToSource", new DescriptiveStatisticsHistogram(WINDOW));
        sourceToIngest = group.histogram("lagSourceToIngest", new DescriptiveStatisticsHistogram(WINDOW));
    }

    void count(ReportedEvent event, boolean isLate) {
        routed.inc();
        bytes.inc(event.isDeletion() ? 0 : event.record().value().length);
        if (isLate) {
            late.inc();
        }
        measure(deviceToSource, event, HeaderNames.TS_DEVICE, HeaderNames.TS_SOURCE);
        measure(sourceToIngest, event, HeaderNames.TS_SOURCE, HeaderNames.TS_INGEST);
    }

    /** Another producer's record may lack a stamp, or have one that is not a number. */
    private static void measure(Histogram lag, ReportedEvent event, String from, String to) {
        String left = event.record().headers().get(from);
        String arrived = event.record().headers().get(to);
        if (left != null && arrived != null && isNumber(left) && isNumber(arrived)) {
            lag.update(Long.parseLong(arrived) - Long.parseLong(left));
        }
    }

    private static boolean isNumber(String text) {
        boolean number = !text.isEmpty() && text.length() <= 18;
        for (int i = 0; number && i < text.length(); i++) {
            number = text.charAt(i) >= '0' && text.charAt(i) <= '9';
        }
        return number;
    }
}
