package io.furrow.connect.subscription;

import java.time.Duration;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * A subscription as it should be.
 *
 * @param name what it is found again by; all tasks of a connector share its {@code base}
 * @param pace how often it tells, and how long it lives
 */
public record WantedSubscription(Name name, Subject subject, Content content, Target target, Pace pace) {
    /**
     * The description of the subscription: {@code furrow farm 1/2}, with its service path where that is not {@code /#}.
     *
     * @param base of all subscriptions of this connector
     */
    public record Name(String base, IdShare share, String servicePath) {
        private static final String EVERYWHERE = "/#";

        /** The text that is kept in the context broker. */
        public String text() {
            return text(share.label());
        }

        private String text(String label) {
            return base + " " + label + (servicePath.equals(EVERYWHERE) ? "" : " " + servicePath);
        }

        /** Whether a description is one of ours for the same number of tasks. */
        boolean isSibling(String description) {
            for (int i = 0; i < share.count(); i++) {
                if (description.equals(text(new IdShare(i, share.count()).label()))) {
                    return true;
                }
            }
            return false;
        }

        /** Whether a description is one of ours for another number of tasks. */
        boolean isLeftover(String description) {
            String tail = servicePath.equals(EVERYWHERE) ? "" : " " + servicePath;
            if (!description.startsWith(base + " ") || !description.endsWith(tail)) {
                return false;
            }
            int end = description.length() - tail.length();
            int start = base.length() + 1;
            return start < end && description.substring(start, end).matches("\\d+/\\d+") && !isSibling(description);
        }
    }

    /**
     * @param throttling least time between two notifications, whole seconds; what changes meanwhile is not told at all
     * @param expiry how long the subscription lives; empty for ever
     */
    public record Pace(Duration throttling, Optional<Duration> expiry) {
        /** Every change, for ever. */
        public static final Pace EVERY_CHANGE = new Pace(Duration.ZERO, Optional.empty());
    }

    /** The body of a request that makes it. */
    ObjectNode json(Instant now) {
        ObjectNode json = JsonNodeFactory.instance.objectNode().put("description", name.text());
        json.set("subject", subject.json());
        ObjectNode notification = json.putObject("notification");
        content.writeTo(notification);
        target.writeTo(notification);
        if (pace.throttling().toSeconds() > 0) {
            json.put("throttling", pace.throttling().toSeconds());
        }
        pace.expiry().ifPresent(life -> json.put("expires", end(now, life)));
        return json;
    }

    private static String end(Instant now, Duration life) {
        return now.plus(life).truncatedTo(ChronoUnit.SECONDS).toString();
    }

    /** Whether the end of a subscription as the context broker shows it is neither near nor further than wanted. */
    boolean lastsLongEnough(JsonNode shown, Instant now) {
        Optional<Instant> end = BrokerTime.parse(shown.path("expires").asText(""));
        if (pace.expiry().isEmpty() || end.isEmpty()) {
            return pace.expiry().isEmpty() && end.isEmpty();
        }
        Duration left = Duration.between(now, end.get());
        Duration life = pace.expiry().get();
        return left.compareTo(life.dividedBy(2)) > 0 && left.compareTo(life.plus(life)) < 0;
    }
}
