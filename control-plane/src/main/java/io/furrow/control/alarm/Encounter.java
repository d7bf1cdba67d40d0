package io.furrow.control.alarm;

import java.util.List;
import java.util.Locale;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * What a record of {@code data.collision} says.
 *
 * @param id of the encounter
 * @param phase {@code started}, {@code ended}, {@code predicted} and so on
 * @param distance metres; NaN where it is not said
 * @param minDistance metres, the least so far; NaN where it is not said
 */
public record Encounter(
        String id, String phase, Member first, Member second, double distance, double minDistance, FiwareScope scope) {
    /**
     * One of the two.
     *
     * @param id of its entity
     * @param mission empty where it is on none
     */
    public record Member(String id, String mission) {}

    /** @throws UnreadableException where it is no entity or tells of no encounter */
    public static Encounter read(byte[] value, FiwareScope scope) throws UnreadableException {
        Entity entity = Entity.parse(value);
        return new Encounter(
                needed(entity, "encounter"),
                needed(entity, "phase"),
                member(entity, "Device1"),
                member(entity, "Device2"),
                entity.number("distance").orElse(Double.NaN),
                entity.number("minDistance").orElse(entity.number("dcpa").orElse(Double.NaN)),
                scope);
    }

    /** By which the pair is known: both ids, the lesser first. */
    public String pair() {
        return first.id() + "-" + second.id();
    }

    public List<Member> members() {
        return List.of(first, second);
    }

    /** Of the first that is on one; empty where neither is. */
    String mission() {
        return first.mission().isEmpty() ? second.mission() : first.mission();
    }

    /** For people. */
    String metres() {
        double said = Double.isNaN(minDistance) ? distance : minDistance;
        return String.format(Locale.ROOT, "%.1f m", said);
    }

    private static Member member(Entity entity, String device) throws UnreadableException {
        return new Member(
                needed(entity, device + "_ID"), entity.text(device + "_Mission").orElse(""));
    }

    private static String needed(Entity entity, String attribute) throws UnreadableException {
        return entity.text(attribute)
                .orElseThrow(() -> new UnreadableException(
                        Reason.NOT_AN_EVENT, "the encounter has no attribute '" + attribute + "'"));
    }
}
