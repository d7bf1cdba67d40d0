package io.furrow.connect.source;

import java.time.Duration;
import java.util.List;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

import io.furrow.connect.Validators;

/** Which entities are taken, and how far their clocks may be ahead. */
record EntityOptions(AbstractConfig config) {
    static final String EXCLUDE_TYPES = "exclude.types";
    static final String MAX_CLOCK_SKEW = "max.clock.skew.ms";

    private static final long HOUR = Duration.ofHours(1).toMillis();

    static void define(ConfigDef options) {
        String group = "Entities";
        options.define(
                EXCLUDE_TYPES,
                Type.LIST,
                "Analytics:.*,Domain,Mission",
                Validators.patterns(),
                Importance.MEDIUM,
                "Regular expressions separated by commas. An entity whose whole type matches one is dropped and counted."
                        + " Name here what is written into the context broker from Kafka, or it comes back as news.",
                group,
                1,
                Width.LONG,
                "Excluded types");
        options.define(
                MAX_CLOCK_SKEW,
                Type.LONG,
                300_000L,
                Range.between(0, HOUR - 1),
                Importance.MEDIUM,
                "Milliseconds that a device's clock may be ahead, less than an hour. Beyond it the event gets the time of"
                        + " receipt and the device is named in the log.",
                group,
                2,
                Width.SHORT,
                "Clock skew (ms)");
    }

    List<Pattern> excludedTypes() {
        return config.getList(EXCLUDE_TYPES).stream().map(Pattern::compile).toList();
    }

    Duration maxClockSkew() {
        return Duration.ofMillis(config.getLong(MAX_CLOCK_SKEW));
    }
}
