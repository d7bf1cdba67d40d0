package io.furrow.connect.source.option;

import java.time.Duration;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Validator;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.model.event.EventTimeRule;

/** Options for the entities that the source accepts and the clock skew that it tolerates. */
public record EntityOptions(AbstractConfig config) {
    public static final String MAX_CLOCK_SKEW = "max.clock.skew.ms";
    static final String EXCLUDE_TYPES = "exclude.types";
    static final String EVENT_TIME = "event.time";

    private static final String DEFAULT_TIMES =
            EventTimeRule.DEFAULT_ORDER.stream().map(EventTimeRule.Source::code).collect(Collectors.joining(","));
    private static final long HOUR = Duration.ofHours(1).toMillis();

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Entities");
        group.list(EXCLUDE_TYPES, "Analytics:.*,Domain,Mission", Validators.patterns(), "Excluded types")
                .help("Regular expressions separated by commas. An entity whose whole type matches one is dropped and"
                        + " counted. List the types that are written from Kafka into the context broker, or they are"
                        + " read back as new events.");
        group.number(MAX_CLOCK_SKEW, 300_000L, Range.between(0, HOUR - 1), "Clock skew (ms)")
                .help("Milliseconds that a device's clock may be ahead, less than an hour. Beyond it the event gets the"
                        + " time of receipt and the device is named in the log.");
        Validator sources =
                Validators.one(EntityOptions::requireEventTimes, DEFAULT_TIMES + " in the order of their weight");
        group.list(EVENT_TIME, DEFAULT_TIMES, sources, "Event time")
                .help("Sources of the event time, in order: the first that an event has is used. device: its attribute"
                        + " Time, else TimeInstant, dateObserved, timestamp. attributes: the newest metadata"
                        + " dateModified of its attributes. entity: its dateModified. An event that has none of them"
                        + " gets the time of receipt.");
    }

    public List<Pattern> excludedTypes() {
        return config.getList(EXCLUDE_TYPES).stream().map(Pattern::compile).toList();
    }

    public EventTimeRule eventTimes() {
        return EventTimeRule.of(config.getList(EVENT_TIME), Duration.ofMillis(config.getLong(MAX_CLOCK_SKEW)));
    }

    private static void requireEventTimes(List<?> sources) {
        EventTimeRule.of(sources.stream().map(String::valueOf).toList(), Duration.ZERO);
    }
}
