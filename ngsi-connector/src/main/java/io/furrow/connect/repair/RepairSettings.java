package io.furrow.connect.repair;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.regex.Pattern;

import io.furrow.model.event.EventTimeRule;

/**
 * The settings of a repair.
 *
 * @param folder for persistent state
 * @param overlap how long before the last known good time the reading begins
 * @param mode which changes are read
 * @param reading how the context broker is queried, and which entities are excluded
 * @param deletions how deletions are detected
 */
public record RepairSettings(Path folder, Duration overlap, Mode mode, Reading reading, Deletions deletions) {
    /** The changes to read from the context broker. */
    public enum Mode {
        /** None: missed changes stay missed. */
        OFF,
        /** Changes since the last known good time; none for a new subscription. */
        CHANGES,
        /** The same and, for a new subscription, every entity. */
        INITIAL
    }

    /**
     * @param pageSize entities per request
     * @param pageMaxBytes of the body of an answer
     * @param times which time of an entity is that of its event
     * @param excluded types, matched as a whole
     */
    public record Reading(int pageSize, long pageMaxBytes, EventTimeRule times, List<Pattern> excluded) {
        boolean isExcluded(String type) {
            return excluded.stream().anyMatch(pattern -> pattern.matcher(type).matches());
        }
    }

    /**
     * @param knownMaxBytes heap per subscription for the ids of known entities
     * @param interval minimum time between listings of all ids, except after starts and removed or stopped
     *     subscriptions
     */
    public record Deletions(long knownMaxBytes, Duration interval) {}
}
