package io.furrow.fiware.broker;

import java.net.URI;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The definition of a subscription.
 *
 * @param json as {@code GET} shows it, without id, status and counters
 */
public record SubscriptionDefinition(
        Subject subject, Target target, Rendering rendering, boolean onlyChanged, Limits limits, ObjectNode json) {
    /** The definition as a request, with its status. */
    public ObjectNode requested() {
        return json.deepCopy().put("status", limits.active() ? "active" : "inactive");
    }

    /** Selects entities by id and type. */
    record Selector(Predicate<String> id, Predicate<String> type) {
        boolean matches(StoredEntity entity) {
            return type.test(entity.type()) && id.test(entity.id());
        }
    }

    /**
     * Selects changes.
     *
     * @param entities any of them
     */
    record Subject(List<Selector> entities, Set<EntityChange.Kind> kinds) {
        boolean covers(EntityChange change) {
            StoredEntity entity = change.after();
            return kinds.contains(change.kind()) && entities.stream().anyMatch(selector -> selector.matches(entity));
        }
    }

    /**
     * The receiver of notifications.
     *
     * @param headers additional or replaced headers; an empty value removes one
     * @param timeout after which a missing answer is a failure
     */
    record Target(URI url, Map<String, String> headers, Duration timeout) {}

    /**
     * Limits of notification.
     *
     * @param throttling minimum time between two notifications; those in between are not sent
     * @param maxFails consecutive failures after which the subscription is deactivated
     */
    record Limits(boolean active, Optional<Instant> expires, Duration throttling, Optional<Integer> maxFails) {}
}
