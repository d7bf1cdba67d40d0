package io.furrow.control.alarm.watch;

import java.util.List;
import java.util.Optional;
import java.util.function.Function;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.result.CollisionResult;

/**
 * An encounter of two devices from a record of {@code data.collision}.
 *
 * @param id of the encounter
 * @param phase {@code started}, {@code ended}, {@code predicted} and so on
 * @param distance meters; NaN if not given
 * @param minDistance meters, the minimum so far; NaN if not given
 */
public record EncounterReport(
        String id, String phase, Member first, Member second, double distance, double minDistance) {
    /**
     * One of the two devices.
     *
     * @param id of its entity
     * @param mission empty if it is on none
     * @param type of its entity; empty if the record does not name it
     * @param scope of its entity
     */
    public record Member(String id, String mission, String type, FiwareScope scope) {
        /**
         * Returns the type of the entity; null if unknown.
         *
         * @param existing types by tenant, service path and id, for records that name none
         */
        public String type(Function<String, String> existing) {
            return type.isEmpty() ? existing.apply(scope.identity(id)) : type;
        }
    }

    /**
     * @param scope of the record, which is that of the first device, and of the second unless the record names another
     * @throws UnreadableException if the value is not an entity or not an encounter
     */
    public static EncounterReport read(byte[] value, FiwareScope scope) throws UnreadableException {
        Entity entity = Entity.parse(value);
        return new EncounterReport(
                required(entity, CollisionResult.ENCOUNTER),
                required(entity, CollisionResult.PHASE),
                member(entity, CollisionResult.FIRST, scope),
                member(entity, CollisionResult.SECOND, scope),
                entity.number(CollisionResult.DISTANCE).orElse(Double.NaN),
                entity.number(CollisionResult.MIN_DISTANCE)
                        .orElse(entity.number(CollisionResult.DCPA).orElse(Double.NaN)));
    }

    /** Returns the key of the pair: both ids, the lesser first. */
    public String pair() {
        return first.id() + "-" + second.id();
    }

    /** Returns the unambiguous identity of the pair: tenant, service path, both types and the pair; also the second's scope if it differs. */
    String identity() {
        FiwareScope other = second.scope();
        String type = other.equals(first.scope()) ? second.type() : other.identity(second.type());
        return first.scope().identity((first.type() + " " + type).strip(), pair());
    }

    public List<Member> members() {
        return List.of(first, second);
    }

    /** Returns the mission of the first device that has one; empty if neither has. */
    String mission() {
        return first.mission().isEmpty() ? second.mission() : first.mission();
    }

    double meters() {
        return Double.isNaN(minDistance) ? distance : minDistance;
    }

    private static Member member(Entity entity, CollisionResult.Member names, FiwareScope usual)
            throws UnreadableException {
        Optional<String> path = entity.text(names.servicePath());
        return new Member(
                required(entity, names.id()),
                entity.text(names.mission()).orElse(""),
                entity.text(names.type()).orElse(""),
                path.isEmpty()
                        ? usual
                        : FiwareScope.of(entity.text(names.service()).orElse(""), path.get()));
    }

    private static String required(Entity entity, String attribute) throws UnreadableException {
        return entity.text(attribute)
                .orElseThrow(() -> new UnreadableException(
                        Reason.NOT_AN_EVENT, "the encounter has no attribute '" + attribute + "'"));
    }
}
