package io.furrow.connect.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.repair.RepairSettings;
import io.furrow.connect.repair.RepairSettings.Mode;
import io.furrow.connect.repair.RepairSettings.Reading;

/** What is read from the context broker after notifications were or may have been missed. */
record RepairOptions(AbstractConfig config) {
    static final String MODE = "repair.mode";
    static final String OVERLAP = "repair.overlap.ms";
    static final String PAGE_SIZE = "repair.page.size";
    static final String KNOWN_MAX = "repair.known.max";

    private static final String GROUP = "Repair";

    static void define(ConfigDef options) {
        OptionGroup declare = new OptionGroup(options, GROUP);
        declare.choice(
                MODE,
                List.of("changes", "initial", "off"),
                "Mode",
                "What is read from the context broker after a start, an outage or a failure: changes since the last time"
                        + " known good; initial, the same, and every entity there is for a subscription that is new; or off."
                        + " What was not seen before becomes a record with the header origin=repair.");
        declare.number(
                OVERLAP,
                120_000,
                Range.between(1_000, 86_400_000),
                "Overlap (ms)",
                "Milliseconds before the last time known good that the reading begins. Longer than the context broker may"
                        + " keep a notification waiting, and than the clocks of its instances may differ.");
        declare.number(
                PAGE_SIZE,
                500,
                Range.between(2, 1000),
                "Page",
                "Entities asked for at a time. Smaller ones for entities that hold images.");
        declare.number(
                KNOWN_MAX,
                200_000,
                Range.between(0, 10_000_000),
                "Known entities",
                "Entities per subscription whose ids are kept to find deletions that were not told, about 150 bytes of memory"
                        + " each. With more entities than this none is found.");
    }

    /**
     * @param folder for what outlives a restart
     * @param entities what is left out
     */
    RepairSettings settings(Path folder, EntityOptions entities) {
        return new RepairSettings(
                folder,
                Duration.ofMillis(config.getLong(OVERLAP)),
                Mode.valueOf(config.getString(MODE).toUpperCase(Locale.ROOT)),
                new Reading(config.getLong(PAGE_SIZE).intValue(), entities.eventTimes(), entities.excludedTypes()),
                config.getLong(KNOWN_MAX).intValue());
    }
}
