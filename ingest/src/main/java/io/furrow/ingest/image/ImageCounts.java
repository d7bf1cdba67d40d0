package io.furrow.ingest.image;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.metrics.ThreadSafeSimpleCounter;

import io.furrow.flink.job.PerMission;
import io.furrow.flink.record.DeadCounters;
import io.furrow.ingest.route.ReportedEvent;

/**
 * Metrics of the images of a subtask: {@code images}, {@code imageBytes} and {@code dead} (events with a broken one), in all and
 * in groups {@code domain} and {@code mission}, {@code imageRetries}, and the gauge {@code imageBytesInFlight}.
 */
final class ImageCounts {
    private final Stored all;
    private final PerMission<Stored> perMission;
    private final DeadCounters dead;
    private final Counter retries;

    /** Counts what was stored. */
    private record Stored(Counter images, Counter bytes) {
        static Stored in(MetricGroup group) {
            return new Stored(group.counter("images"), group.counter("imageBytes"));
        }

        void add(Moved moved) {
            images.inc(moved.images());
            bytes.inc(moved.bytes());
        }
    }

    ImageCounts(MetricGroup group, Gauge<Long> inFlight) {
        all = Stored.in(group);
        perMission = new PerMission<>(group, PerMission.USUAL_LIMIT, Stored::in);
        dead = new DeadCounters(group);
        retries = group.counter("imageRetries", new ThreadSafeSimpleCounter());
        group.gauge("imageBytesInFlight", inFlight);
    }

    void count(ReportedEvent event, Moved moved) {
        if (moved.broken() != null) {
            dead.count(moved.broken(), event.domain(), event.mission());
        }
        if (moved.images() > 0) {
            all.add(moved);
            perMission.of(event.domain(), event.mission()).add(moved);
        }
    }

    /** From any thread. */
    void retried() {
        retries.inc();
    }
}
