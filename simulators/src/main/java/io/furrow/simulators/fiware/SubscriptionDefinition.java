package io.furrow.simulators.fiware;

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
 * What a client wants to be told of, and how.
 *
 * @param json as {@code GET} shows it, without id, status and counters
 */
record SubscriptionDefinition(
        Subject subject, Target target, Rendering rendering, boolean onlyChanged, Limits limits, ObjectNode json) {
    /** As a request would give it, with its status. */
    ObjectNode requested() {
        return json.deepCopy().put("status", limits.active() ? "active" : "inactive");
    }

    /** Entities whose id and type pass. */
    record Selector(Predicate<String> id, Predicate<String> type) {
        boolean matches(StoredEntity entity) {
            return type.test(entity.type()) && id.test(entity.id());
        }
    }

    /**
     * Which changes of which entities.
     *
     * @param attributes one of these must have changed; empty for any
     * @param filter that the entity must pass after the change
     */
    record Subject(
            List<Selector> entities, Set<String> attributes, Optional<QueryFilter> filter, Set<Change.Kind> kinds) {
        boolean covers(Change change) {
            StoredEntity entity = change.after();
            return kinds.contains(change.kind())
                    && entities.stream().anyMatch(selector -> selector.matches(entity))
                    && (attributes.isEmpty() || touches(change))
                    && filter.map(passes -> passes.test(entity)).orElse(true);
        }

        private boolean touches(Change change) {
            Set<String> named =
                    change.kind() == Change.Kind.UPDATE ? change.actions().keySet() : change.changed();
            return named.stream().anyMatch(attributes::contains);
        }
    }

    /**
     * Where notifications go.
     *
     * @param headers sent besides and instead of the usual ones; an empty value takes a header away
     * @param timeout until an answer that is missing counts as a failure
     */
    record Target(URI url, Map<String, String> headers, Duration timeout) {}

    /**
     * When it stays silent.
     *
     * @param throttling least time between two notifications; what falls between is not sent at all
     * @param maxFails consecutive failures after which the subscription is set inactive
     */
    record Limits(boolean active, Optional<Instant> expires, Duration throttling, Optional<Integer> maxFails) {}
}
