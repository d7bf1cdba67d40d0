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
 * Which of the times that an event may carry is its event time.
 *
 * @param order the first of these that can be read decides; where none can, the time of receipt does
 * @param maxSkew how far a time may be after the receipt
 */
public record EventTimeRule(List<Source> order, Duration maxSkew) implements Serializable {
    /** The device knows best; of what the context broker adds, the newest change of an attribute is closer than that of the entity. */
    public static final List<Source> DEFAULT_ORDER = List.of(Source.DEVICE, Source.ATTRIBUTES, Source.ENTITY);

    /** Where a time is read from. */
    public enum Source implements Coded {
        /** {@code Time} (epoch ms), else {@code TimeInstant}, {@code dateObserved}, {@code timestamp} (see {@link Instants}). */
        DEVICE,
        /**
         * The newest metadata {@code dateModified} of an attribute. Metadata {@code TimeInstant} is none: the context broker keeps
         * it when somebody changes the value without it.
         */
        ATTRIBUTES,
        /** {@code dateModified} of the entity. */
        ENTITY;

        /** Attributes that hold the time of the device, the first that can be read before the others. */
        public static final List<String> DEVICE_TIMES = List.of("Time", "TimeInstant", "dateObserved", "timestamp");

        /** The time that an entity has from here; empty if none can be read. */
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

        /** Whether the device gives a time, of whatever form. */
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

        private static Source of(String word) {
            return List.of(values()).stream()
                    .filter(source -> source.code().equals(word))
                    .findFirst()
                    .orElseThrow(() -> new IllegalArgumentException(
                            "'%s' is not an event time; give some of device, attributes, entity in the order of their weight"
                                    .formatted(word)));
        }
    }

    /** @throws IllegalArgumentException where the order is empty or names a source twice */
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
     * The rule that an option names, as in {@code device,attributes,entity}.
     *
     * @throws IllegalArgumentException with what was wrong and what can be given
     */
    public static EventTimeRule of(List<String> words, Duration maxSkew) {
        return new EventTimeRule(words.stream().map(Source::of).toList(), maxSkew);
    }
}
