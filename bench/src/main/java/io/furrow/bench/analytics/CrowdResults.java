package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.bench.analytics.load.CrowdedFleet;
import io.furrow.bench.analytics.load.FleetTopic;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.TopicReader;

/** Follows the results of devices on one spot and of the fleet beside them. */
final class CrowdResults implements AutoCloseable {
    private static final String STARTED = "\"started\"";
    /** In event time, at the end, where results may still be missing. */
    private static final long OPEN_SECONDS = 4;

    private static final long MAX_LAG = 10_000;

    private final FleetTopic topic;
    private final TopicReader reader;
    /** Encounters of the fleet by the second in which they start. */
    private final Map<Long, Integer> starts = new ConcurrentHashMap<>();

    private final List<String> overflows = Collections.synchronizedList(new ArrayList<>());
    private final List<Long> lags = new ArrayList<>();
    private volatile long newestOfCrowd;
    private volatile long newestOfFleet;
    private volatile long count;
    private int compared;
    private int different;

    CrowdResults(FleetTopic topic) {
        this.topic = topic;
        reader = TopicReader.fromBeginning(topic.kafka(), Map.of(), topic.results(), topic.overflows())
                .follow(records -> records.forEach(this::take));
    }

    /** Records the delay of the newest result of the crowd, or of the fleet, in milliseconds. */
    long recordLag() {
        long oldest = Math.min(newestOfCrowd, newestOfFleet);
        lags.add(System.currentTimeMillis() - Math.max(oldest, topic.begin()));
        return lags.get(lags.size() - 1);
    }

    long count() {
        return count;
    }

    List<String> overflows() {
        return overflows;
    }

    /** Compares the starts of a fleet of this size with those of the bare loop. */
    void compare(int devices) {
        BaselineLoop loop = new BaselineLoop(devices, CrowdedFleet::rounded);
        compared = (int) Math.max(0, (newestOfFleet - topic.begin()) / 1000 - OPEN_SECONDS);
        for (long second = 0; second < compared; second++) {
            different += loop.second(second) == starts.getOrDefault(second, 0) ? 0 : 1;
        }
    }

    /** Whether no result was delayed by more than 10 s, and the results of the fleet are complete. */
    boolean isSustained() {
        return Collections.max(lags) <= MAX_LAG && different == 0 && compared > 0;
    }

    void addTo(Figures figures, int crowd, int others, Duration warmUp) {
        figures.add(
                "crowd", crowd,
                "others", others,
                "seconds", lags.size(),
                "max lag ms", Collections.max(lags),
                "last lag ms", lags.get(lags.size() - 1),
                "found/s", (double) count / (warmUp.toSeconds() + lags.size()),
                "overflows", overflows.size(),
                "differ", different + "/" + compared,
                "held", isSustained());
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread reads
    private void take(ConsumerRecord<byte[], byte[]> record) {
        if (record.topic().equals(topic.overflows())) {
            overflows.add(TopicReader.text(record.value()));
            return;
        }
        count++;
        if (TopicReader.text(record.key()).contains(CrowdedFleet.CROWD)) {
            newestOfCrowd = Math.max(newestOfCrowd, record.timestamp());
            return;
        }
        newestOfFleet = Math.max(newestOfFleet, record.timestamp());
        if (TopicReader.text(record.value()).contains(STARTED)) {
            starts.merge((record.timestamp() - topic.begin()) / 1000, 1, Integer::sum);
        }
    }

    @Override
    public void close() {
        reader.close();
    }
}
