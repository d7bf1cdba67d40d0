package io.furrow.control.replay;

import java.time.Duration;
import java.util.Objects;

/**
 * Settings of replays.
 *
 * @param mongo connection string of the MongoDB that stores the missions; null if unknown, so that recorded missions
 *     are unknown too
 * @param database of the missions
 * @param pollInterval between queries for the names of recorded missions
 * @param grace retention of a replay's topics after it was over
 * @param endedRetention how long a replay that ended can be played again
 * @param max maximum number of replays that are not over
 */
public record ReplaySettings(
        String mongo, String database, Duration pollInterval, Duration grace, Duration endedRetention, int max) {
    private static final int MAX = 256;

    /** No MongoDB; topics and replays are retained for an hour after their end; at most 256 replays. */
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

    /** Whether recorded missions are known. */
    public boolean hasRecordings() {
        return mongo != null;
    }

    /** Returns a description without the password. */
    @Override
    public String toString() {
        return "%d replays of %s, polled every %s, topics kept for %s, ended replays for %s"
                .formatted(max, mongo == null ? "no MongoDB" : database, pollInterval, grace, endedRetention);
    }
}
