package io.furrow.ingest.image;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.metrics.ThreadSafeSimpleCounter;

import io.furrow.flink.job.PerMissionMetrics;
import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.ingest.route.ReportedEvent;

/**
 * Metrics of the images of a subtask: {@code images}, {@code imageBytes} and {@code dead} (events with a broken image), in total
 * and in groups {@code domain} and {@code mission}, {@code imageRetries}, and the gauge {@code imageBytesInFlight}.
 */
final class ImageCounts {
    private final Stored all;
    private final PerMissionMetrics<Stored> perMissionMetrics;
    private final DeadLetterCounters dead;
    private final Counter retries;

    /** Counts stored images. */
    private record Stored(Counter images, Counter bytes) {
        static Stored in(MetricGroup group) {
            return new Stored(group.counter("images"), group.counter("imageBytes"));
        }

        void add(MoveResult moveResult) {
            images.inc(moveResult.images());
            bytes.inc(moveResult.bytes());
        }
    }

    ImageCounts(MetricGroup group, Gauge<Long> inFlight) {
        all = Stored.in(group);
        perMissionMetrics = new PerMissionMetrics<>(group, PerMissionMetrics.USUAL_LIMIT, Stored::in);
        dead = new DeadLetterCounters(group);
        retries = group.counter("imageRetries", new ThreadSafeSimpleCounter());
        group.gauge("imageBytesInFlight", inFlight);
    }

    void count(ReportedEvent event, MoveResult moveResult) {
        if (moveResult.broken() != null) {
            dead.count(moveResult.broken(), event.domain(), event.mission());
        }
        if (moveResult.images() > 0) {
            all.add(moveResult);
            perMissionMetrics.of(event.domain(), event.mission()).add(moveResult);
        }
    }

    /** Thread-safe. */
    void retried() {
        retries.inc();
    }
}
