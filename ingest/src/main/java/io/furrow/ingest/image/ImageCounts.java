package io.furrow.ingest.image;

import java.util.HashMap;
import java.util.Map;

import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.metrics.ThreadSafeSimpleCounter;

import io.furrow.ingest.route.ReportedEvent;

/**
 * Metrics of the images of a subtask: {@code images} and {@code imageBytes} in all and in groups {@code domain} and {@code
 * mission}, {@code brokenImages} (events with one), {@code imageRetries}, and the gauge {@code imageBytesInFlight}.
 */
final class ImageCounts {
    private final MetricGroup group;
    private final Counter images;
    private final Counter bytes;
    private final Counter broken;
    private final Counter retries;
    private final Map<String, Counter[]> byMission = new HashMap<>();

    ImageCounts(MetricGroup group, Gauge<Long> inFlight) {
        this.group = group;
        images = group.counter("images");
        bytes = group.counter("imageBytes");
        broken = group.counter("brokenImages");
        retries = group.counter("imageRetries", new ThreadSafeSimpleCounter());
        group.gauge("imageBytesInFlight", inFlight);
    }

    void count(ReportedEvent event, Moved moved) {
        broken.inc(moved.deadLetters().size());
        if (moved.images() > 0) {
            images.inc(moved.images());
            bytes.inc(moved.bytes());
            Counter[] own = byMission.computeIfAbsent(event.domain() + "\n" + event.mission(), key -> {
                MetricGroup mission = group.addGroup("domain", event.domain()).addGroup("mission", event.mission());
                return new Counter[] {mission.counter("images"), mission.counter("imageBytes")};
            });
            own[0].inc(moved.images());
            own[1].inc(moved.bytes());
        }
    }

    /** From any thread. */
    void retried() {
        retries.inc();
    }
}
