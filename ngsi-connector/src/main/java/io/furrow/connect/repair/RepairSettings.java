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
 * @param mostKnown entities per tenant whose deletion can be found
 */
public record RepairSettings(Path folder, Duration overlap, Mode mode, Reading reading, int mostKnown) {
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
     * @param times which time of an entity is that of its event
     * @param excluded types, matched as a whole
     */
    public record Reading(int pageSize, EventTimeRule times, List<Pattern> excluded) {
        boolean isExcluded(String type) {
            return excluded.stream().anyMatch(pattern -> pattern.matcher(type).matches());
        }
    }
}
