package io.furrow.connect.source;

import java.time.Duration;
import java.util.List;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.Validators;
import io.furrow.model.event.EventTimeRule;

/** Which entities are taken, and how far their clocks may be ahead. */
record EntityOptions(AbstractConfig config) {
    static final String EXCLUDE_TYPES = "exclude.types";
    static final String MAX_CLOCK_SKEW = "max.clock.skew.ms";
    static final String EVENT_TIME = "event.time";

    private static final String DEFAULT_TIMES =
            EventTimeRule.DEFAULT_ORDER.stream().map(EventTimeRule.Source::word).collect(Collectors.joining(","));
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
        options.define(
                EVENT_TIME,
                Type.LIST,
                DEFAULT_TIMES,
                new EventTimes(),
                Importance.MEDIUM,
                "Which time of an event is its event time: the first of these that it has. device: its attribute Time, else"
                        + " TimeInstant, dateObserved, timestamp. attributes: the newest metadata dateModified of its attributes."
                        + " entity: its dateModified. An event that has none of them gets the time of receipt.",
                group,
                3,
                Width.MEDIUM,
                "Event time");
    }

    List<Pattern> excludedTypes() {
        return config.getList(EXCLUDE_TYPES).stream().map(Pattern::compile).toList();
    }

    EventTimeRule eventTimes() {
        return EventTimeRule.of(config.getList(EVENT_TIME), Duration.ofMillis(config.getLong(MAX_CLOCK_SKEW)));
    }

    private static final class EventTimes implements ConfigDef.Validator {
        @Override
        public void ensureValid(String name, Object value) {
            try {
                EventTimeRule.of(((List<?>) value).stream().map(String::valueOf).toList(), Duration.ZERO);
            } catch (IllegalArgumentException e) {
                throw new ConfigException(name, value, e.getMessage());
            }
        }

        @Override
        public String toString() {
            return DEFAULT_TIMES + " in the order of their weight";
        }
    }
}
