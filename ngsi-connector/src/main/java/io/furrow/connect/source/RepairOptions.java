package io.furrow.connect.source;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.repair.RepairSettings;
import io.furrow.connect.repair.RepairSettings.Deletions;
import io.furrow.connect.repair.RepairSettings.Mode;
import io.furrow.connect.repair.RepairSettings.Reading;

/** What is read from the context broker after notifications were or may have been missed. */
record RepairOptions(AbstractConfig config) {
    static final String MODE = "repair.mode";
    static final String OVERLAP = "repair.overlap.ms";
    static final String PAGE_SIZE = "repair.page.size";
    static final String PAGE_MAX_BYTES = "repair.page.max.bytes";
    static final String KNOWN_MAX_BYTES = "repair.known.max.bytes";
    static final String RECENT_MAX_BYTES = "repair.recent.max.bytes";
    static final String DELETIONS_INTERVAL = "repair.deletions.interval.ms";

    private static final String GROUP = "Repair";
    private static final long MIB = 1024 * 1024;

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
                "Entities asked for at a time; fewer where they are large, see " + PAGE_MAX_BYTES + ".");
        declare.number(
                PAGE_MAX_BYTES,
                16 * MIB,
                Range.between(64 * 1024, 1024 * MIB),
                "Page (bytes)",
                "Bytes that an answer of the context broker may have; read, it takes up to four times as much memory. A larger"
                        + " page is asked for in parts. An entity that is larger by itself becomes a dead letter.");
        defineMemory(declare);
    }

    private static void defineMemory(OptionGroup declare) {
        declare.number(
                KNOWN_MAX_BYTES,
                64 * MIB,
                Range.between(0, 16_384 * MIB),
                "Known entities (bytes)",
                "Bytes of memory per subscription for the ids of entities on the topic, which find deletions that were not"
                        + " told: 104 and two for each sign of tenant, path and id. With more entities than fit none is"
                        + " found.");
        declare.number(
                RECENT_MAX_BYTES,
                64 * MIB,
                Range.between(64 * 1024, 16_384 * MIB),
                "Last records (bytes)",
                "Bytes of memory for the last record of each entity, which finds notifications that come late: 320 and two for"
                        + " each sign of tenant, path and id. Those that were quiet longest are forgotten; what comes late"
                        + " of one of these is asked for again.");
        declare.number(
                DELETIONS_INTERVAL,
                600_000,
                Range.between(0, 86_400_000),
                "Deletions (ms)",
                "Least milliseconds between two listings of all ids, which find deletions that were not told. After a start, and"
                        + " after a subscription was gone or stopped, they are listed at once; after any other gap when so"
                        + " many have passed.");
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
                new Reading(
                        config.getLong(PAGE_SIZE).intValue(),
                        pageMaxBytes(),
                        entities.eventTimes(),
                        entities.excludedTypes()),
                new Deletions(config.getLong(KNOWN_MAX_BYTES), Duration.ofMillis(config.getLong(DELETIONS_INTERVAL))));
    }

    long pageMaxBytes() {
        return config.getLong(PAGE_MAX_BYTES);
    }

    long recentMaxBytes() {
        return config.getLong(RECENT_MAX_BYTES);
    }
}
