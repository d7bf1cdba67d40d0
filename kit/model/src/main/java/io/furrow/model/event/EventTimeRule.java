package io.furrow.model.event;

import java.io.Serializable;
import java.time.Duration;
import java.time.Instant;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.text.Coded;
import io.furrow.model.time.Instants;

/**
 * Selects the event time among the times of an event.
 *
 * @param order the first readable one of these counts; without one, the time of receipt does
 * @param maxSkew how far a time may be after the receipt
 */
public record EventTimeRule(List<Source> order, Duration maxSkew) implements Serializable {
    /**
     * The device's time is the most accurate; of the context broker's times, the newest change of an attribute is
     * closer than that of the entity.
     */
    public static final List<Source> DEFAULT_ORDER = List.of(Source.DEVICE, Source.ATTRIBUTES, Source.ENTITY);

    /** The sources of a time. */
    public enum Source implements Coded {
        /** {@code Time} (epoch ms), else {@code TimeInstant}, {@code dateObserved}, {@code timestamp} (see {@link Instants}). */
        DEVICE,
        /**
         * The newest metadata {@code dateModified} of an attribute. Metadata {@code TimeInstant} does not count: the
         * context broker retains it when the value changes without it.
         */
        ATTRIBUTES,
        /** {@code dateModified} of the entity. */
        ENTITY;

        /** Attributes with the time of the device; the first readable one counts. */
        public static final List<String> DEVICE_TIMES = List.of("Time", "TimeInstant", "dateObserved", "timestamp");

        /** Reads the time of an entity from this source; empty if there is none. */
        public Optional<Instant> read(Entity entity) {
            return switch (this) {
                case DEVICE ->
                    DEVICE_TIMES.stream()
                            .flatMap(name -> entity.value(name).flatMap(Instants::of).stream())
                            .findFirst();
                case ATTRIBUTES ->
                    entity.attributes().stream()
                            .filter(attribute -> !Entity.BUILT_INS.contains(attribute.getKey()))
                            .map(Map.Entry::getValue)
                            .flatMap(Source::modified)
                            .max(Instant::compareTo);
                case ENTITY -> entity.value(Entity.MODIFIED).flatMap(Instants::of);
            };
        }

        /** Returns whether the device reports a time in any format. */
        boolean isNamed(Entity entity) {
            return DEVICE_TIMES.stream()
                    .flatMap(name -> entity.value(name).stream())
                    .anyMatch(value -> value.isContainerNode()
                            || !value.isNull() && !value.asText().isBlank());
        }

        private static Stream<Instant> modified(JsonNode attribute) {
            JsonNode modified = attribute.path("metadata").path(Entity.MODIFIED).path("value");
            return Instants.of(modified).stream();
        }

        private static Source of(String name) {
            return List.of(values()).stream()
                    .filter(source -> source.code().equals(name))
                    .findFirst()
                    .orElseThrow(() -> new IllegalArgumentException(
                            "'%s' is not an event time; give some of device, attributes, entity in the order of their weight"
                                    .formatted(name)));
        }
    }

    /** @throws IllegalArgumentException if the order is empty or names a source twice */
    public EventTimeRule {
        order = List.copyOf(order);
        if (order.isEmpty() || new LinkedHashSet<>(order).size() < order.size()) {
            throw new IllegalArgumentException(
                    "the order of event times is empty or names one twice: %s".formatted(order));
        }
    }

    public static EventTimeRule within(Duration maxSkew) {
        return new EventTimeRule(DEFAULT_ORDER, maxSkew);
    }

    /**
     * Returns the rule of an option such as {@code device,attributes,entity}.
     *
     * @throws IllegalArgumentException if a word is invalid; the message lists the valid ones
     */
    public static EventTimeRule of(List<String> words, Duration maxSkew) {
        return new EventTimeRule(words.stream().map(Source::of).toList(), maxSkew);
    }
}
