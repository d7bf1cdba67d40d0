package io.furrow.connect.repair;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.regex.Pattern;

import io.furrow.model.event.EventTimeRule;

/**
 * How a repair is done.
 *
 * @param folder for what outlives a restart
 * @param overlap how much before the last known good time it begins
 * @param mode what is read
 * @param reading how the context broker is asked, and what is left out
 * @param deletions how entities that are gone are found
 */
public record RepairSettings(Path folder, Duration overlap, Mode mode, Reading reading, Deletions deletions) {
    /** What is read from the context broker. */
    public enum Mode {
        /** Nothing: what is missed stays missed. */
        OFF,
        /** What changed since the last time known good; nothing for a subscription that is new. */
        CHANGES,
        /** The same, and every entity for a subscription that is new. */
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
     * @param interval at most how often all ids are listed, but for starts and subscriptions that were gone or stopped
     */
    public record Deletions(long knownMaxBytes, Duration interval) {}
}
