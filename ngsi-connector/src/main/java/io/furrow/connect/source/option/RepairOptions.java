package io.furrow.connect.source.option;

import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.broker.BrokerOptions;
import io.furrow.connect.repair.RepairSettings;
import io.furrow.connect.repair.RepairSettings.Deletions;
import io.furrow.connect.repair.RepairSettings.Mode;
import io.furrow.connect.repair.RepairSettings.Reading;

/**
 * Options for the repair, which reads entities from the context broker after notifications were or may have been
 * missed.
 */
public record RepairOptions(AbstractConfig config) {
    static final String MODE = "repair.mode";
    static final String OVERLAP = "repair.overlap.ms";
    static final String PAGE_SIZE = "repair.page.size";
    static final String PAGE_MAX_BYTES = "repair.page.max.bytes";
    static final String KNOWN_MAX_BYTES = "repair.known.max.bytes";
    static final String RECENT_MAX_BYTES = "repair.recent.max.bytes";
    static final String DELETIONS_INTERVAL = "repair.deletions.interval.ms";

    private static final long MIB = 1024 * 1024;

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Repair").shownIf(BrokerOptions.URL, url -> !url.isEmpty());
        group.low()
                .choice(MODE, List.of("changes", "initial", "off"), "Mode")
                .help("Entities to read from the context broker after a start, an outage or a failure: changes since"
                        + " the last time known good; initial, the same and, for a new subscription, every entity; or"
                        + " off. A state that the topic does not have becomes a record with the header origin=repair.");
        group.low()
                .number(OVERLAP, 120_000, Range.between(1_000, 86_400_000), "Overlap (ms)")
                .help("Milliseconds before the last time known good at which the reading begins. Longer than the"
                        + " context broker may delay a notification, and than the clocks of its instances may differ.");
        group.low()
                .number(PAGE_SIZE, 500, Range.between(2, 1000), "Page")
                .help("Entities per request; fewer if they are large, see " + PAGE_MAX_BYTES + ".");
        group.low()
                .number(PAGE_MAX_BYTES, 16 * MIB, Range.between(64 * 1024, 1024 * MIB), "Page (bytes)")
                .help("Maximum bytes of an answer of the context broker; parsed, it needs up to four times as much"
                        + " memory. A larger page is requested in parts. A single entity that is larger becomes a dead"
                        + " letter.");
        defineMemory(group);
    }

    private static void defineMemory(OptionGroup group) {
        group.low()
                .number(KNOWN_MAX_BYTES, 64 * MIB, Range.between(0, 16_384 * MIB), "Known entities (bytes)")
                .help("Bytes of memory per subscription for the ids of entities on the topic, which reveal deletions"
                        + " that were not notified: 104 and two for each character of tenant, path and id. With more"
                        + " entities than fit, no deletion is found.");
        group.low()
                .number(RECENT_MAX_BYTES, 64 * MIB, Range.between(64 * 1024, 16_384 * MIB), "Last records (bytes)")
                .help("Bytes of memory for the last record of each entity, which reveals late notifications: 320 and"
                        + " two for each character of tenant, path and id. Entities without changes for longest are"
                        + " forgotten; a late notification of one of these makes the source read the entity again.");
        group.low()
                .number(DELETIONS_INTERVAL, 600_000, Range.between(0, 86_400_000), "Deletions (ms)")
                .help("Minimum milliseconds between two listings of all ids, which find deletions that were not"
                        + " notified. After a start, and after a subscription was removed or stopped, they are listed"
                        + " immediately; after any other gap when so many have passed.");
    }

    /**
     * @param folder for the state that outlives a restart
     * @param entities options that exclude entities
     */
    public RepairSettings settings(Path folder, EntityOptions entities) {
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

    public long pageMaxBytes() {
        return config.getLong(PAGE_MAX_BYTES);
    }

    public long recentMaxBytes() {
        return config.getLong(RECENT_MAX_BYTES);
    }
}
