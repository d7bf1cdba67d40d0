package io.furrow.control.replay;

import java.time.Duration;
import java.util.Objects;

/**
 * What replays are managed with.
 *
 * @param mongo connection string of the MongoDB that keeps the missions; null if it is not known, and with it which missions are stored
 * @param database of the missions
 * @param pollInterval between two looks at the names of the stored missions
 * @param grace how long topics of a replay are kept after it was over
 * @param endedRetention how long a replay that came to its end can be played again
 * @param max replays that are not over, at one time
 */
public record ReplaySettings(
        String mongo, String database, Duration pollInterval, Duration grace, Duration endedRetention, int max) {
    private static final int MAX = 256;

    /** No MongoDB; topics and replays that ended are kept for an hour; 256 replays. */
    public static final ReplaySettings DEFAULT = new ReplaySettings(
            null, "persistence", Duration.ofSeconds(2), Duration.ofHours(1), Duration.ofHours(1), MAX);

    public ReplaySettings {
        Objects.requireNonNull(database);
        Objects.requireNonNull(pollInterval);
        Objects.requireNonNull(grace);
        Objects.requireNonNull(endedRetention);
    }

    /** @param uri null for none */
    public ReplaySettings withMongo(String uri) {
        return new ReplaySettings(uri, database, pollInterval, grace, endedRetention, max);
    }

    public ReplaySettings withDatabase(String name) {
        return new ReplaySettings(mongo, name, pollInterval, grace, endedRetention, max);
    }

    public ReplaySettings withPollInterval(Duration interval) {
        return new ReplaySettings(mongo, database, interval, grace, endedRetention, max);
    }

    public ReplaySettings withGrace(Duration time) {
        return new ReplaySettings(mongo, database, pollInterval, time, endedRetention, max);
    }

    public ReplaySettings withEndedRetention(Duration time) {
        return new ReplaySettings(mongo, database, pollInterval, grace, time, max);
    }

    public ReplaySettings withMax(int replays) {
        return new ReplaySettings(mongo, database, pollInterval, grace, endedRetention, replays);
    }

    /** Whether it is known which missions are stored. */
    public boolean hasRecordings() {
        return mongo != null;
    }

    /** Holds no password. */
    @Override
    public String toString() {
        return "%d replays of %s, polled every %s, topics kept for %s, ended replays for %s"
                .formatted(max, mongo == null ? "no MongoDB" : database, pollInterval, grace, endedRetention);
    }
}
