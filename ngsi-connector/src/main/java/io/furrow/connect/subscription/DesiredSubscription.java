package io.furrow.connect.subscription;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.time.Instants;

/**
 * The desired state of a subscription.
 *
 * @param name by which it is found again; all tasks of a connector share its {@code base}
 * @param throttling how often it notifies, and when it expires
 */
public record DesiredSubscription(
        Name name, Subject subject, NotificationContent notificationContent, Target target, Throttling throttling) {
    /**
     * The description of the subscription: {@code furrow farm 1/2}, with its service path unless that is {@code /#}.
     *
     * @param base of all subscriptions of this connector
     * @param scope the tenant, and the service path, which may end in {@code /#}
     */
    public record Name(String base, IdPartition partition, FiwareScope scope) {
        private static final String EVERYWHERE = "/#";

        /** The description that is stored in the context broker. */
        public String text() {
            return text(partition.label());
        }

        private String text(String label) {
            return base + " " + label + tail();
        }

        private String tail() {
            return scope.servicePath().equals(EVERYWHERE) ? "" : " " + scope.servicePath();
        }

        /** Whether a description belongs to this connector with the same number of tasks. */
        boolean isSibling(String description) {
            for (int i = 0; i < partition.count(); i++) {
                if (description.equals(text(new IdPartition(i, partition.count()).label()))) {
                    return true;
                }
            }
            return false;
        }

        /** Whether a description belongs to this connector with another number of tasks. */
        boolean isLeftover(String description) {
            String tail = tail();
            if (!description.startsWith(base + " ") || !description.endsWith(tail)) {
                return false;
            }
            int end = description.length() - tail.length();
            int start = base.length() + 1;
            return start < end && description.substring(start, end).matches("\\d+/\\d+") && !isSibling(description);
        }
    }

    /**
     * @param throttling minimum time between two notifications, whole seconds; changes in between are never
     *     notified
     * @param expiry lifetime of the subscription; empty for unlimited
     */
    public record Throttling(Duration throttling, Optional<Duration> expiry) {
        /** Every change, without expiry. */
        public static final Throttling EVERY_CHANGE = new Throttling(Duration.ZERO, Optional.empty());
    }

    public FiwareScope scope() {
        return name.scope();
    }

    /** The body of a request that creates it. */
    ObjectNode json(Instant now) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("description", name.text());
        json.set("subject", subject.json());
        ObjectNode notification = json.putObject("notification");
        notificationContent.writeTo(notification);
        target.writeTo(notification);
        if (throttling.throttling().toSeconds() > 0) {
            json.put("throttling", throttling.throttling().toSeconds());
        }
        throttling.expiry().ifPresent(life -> json.put("expires", end(now, life)));
        return json;
    }

    private static String end(Instant now, Duration life) {
        return now.plus(life).truncatedTo(ChronoUnit.SECONDS).toString();
    }

    /** Whether the expiry of a subscription in the context broker is neither near nor later than desired. */
    boolean lastsLongEnough(JsonNode shown, Instant now) {
        Optional<Instant> end = Instants.ofText(shown.path("expires").asText(""));
        if (throttling.expiry().isEmpty() || end.isEmpty()) {
            return throttling.expiry().isEmpty() && end.isEmpty();
        }
        Duration left = Duration.between(now, end.get());
        Duration life = throttling.expiry().get();
        return left.compareTo(life.dividedBy(2)) > 0 && left.compareTo(life.plus(life)) < 0;
    }
}
