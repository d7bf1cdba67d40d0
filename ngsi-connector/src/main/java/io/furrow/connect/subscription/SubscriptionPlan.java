package io.furrow.connect.subscription;

import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The steps after which the context broker has exactly the desired subscription.
 *
 * <p>The own subscription is the one with our description; of several the one with our address, else the first. The
 * others with our description are removed: each would deliver every change once more. Subscriptions of an earlier
 * number of tasks are removed by the first task, once those of all tasks exist.
 *
 * @param current the own subscription in the context broker; empty if it has to be created
 * @param steps in this order; empty if nothing has to be changed
 * @param leftovers subscriptions of an earlier number of tasks, which may have been notified of changes that are
 *     ours now
 */
record SubscriptionPlan(Optional<JsonNode> current, List<Step> steps, List<JsonNode> leftovers) {
    /** One request. */
    sealed interface Step {
        /** {@code POST} of a new subscription. */
        record Create(ObjectNode json) implements Step {}

        /** {@code PATCH} of the own subscription; {@code members} names the differences, for messages. */
        record Change(String id, ObjectNode json, Set<String> members) implements Step {}

        /** {@code DELETE} of a superfluous subscription. */
        record Remove(String id, String description) implements Step {}
    }

    static SubscriptionPlan of(DesiredSubscription desired, List<JsonNode> listed, Instant now) {
        String description = desired.name().text();
        List<JsonNode> ours = new ArrayList<>(listed.stream()
                .filter(one -> description(one).equals(description))
                .toList());
        Optional<JsonNode> current = ours.stream()
                .filter(one -> url(one).equals(desired.target().url()))
                .findFirst()
                .or(() -> ours.stream().findFirst());
        List<Step> steps = new ArrayList<>();
        if (current.isEmpty()) {
            steps.add(new Step.Create(desired.json(now)));
        } else {
            change(desired, current.get(), now).ifPresent(steps::add);
            ours.remove(current.get());
            ours.forEach(one -> steps.add(remove(one)));
        }
        List<JsonNode> leftovers = listed.stream()
                .filter(one -> desired.name().isLeftover(description(one)))
                .toList();
        if (desired.name().partition().index() == 0 && areAllThere(desired, listed)) {
            leftovers.forEach(one -> steps.add(remove(one)));
        }
        return new SubscriptionPlan(current, List.copyOf(steps), leftovers);
    }

    private static boolean areAllThere(DesiredSubscription desired, List<JsonNode> listed) {
        return listed.stream()
                        .map(SubscriptionPlan::description)
                        .filter(desired.name()::isSibling)
                        .distinct()
                        .count()
                == desired.name().partition().count();
    }

    private static Step remove(JsonNode subscription) {
        return new Step.Remove(id(subscription), description(subscription));
    }

    private static Optional<Step> change(DesiredSubscription desired, JsonNode current, Instant now) {
        ObjectNode asked = desired.json(now);
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        Set<String> members = new TreeSet<>(differing(subject(asked), subject(current)));
        if (!members.isEmpty()) {
            json.set("subject", asked.get("subject"));
        }
        Set<String> notification = differing(notification(asked), notification(current));
        if (!notification.isEmpty()) {
            json.set("notification", asked.get("notification"));
            members.addAll(notification);
        }
        if (asked.path("throttling").asLong() != current.path("throttling").asLong()) {
            json.put("throttling", asked.path("throttling").asLong());
            members.add("throttling");
        }
        if (!desired.lastsLongEnough(current, now)) {
            json.put("expires", asked.path("expires").asText(""));
            members.add("expires");
        }
        if (!current.path("status").asText().equals("active")) {
            json.put("status", "active");
            members.add("status");
        }
        return json.isEmpty() ? Optional.empty() : Optional.of(new Step.Change(id(current), json, members));
    }

    private static Set<String> differing(Map<String, Object> asked, Map<String, Object> current) {
        Set<String> names = new TreeSet<>(asked.keySet());
        names.addAll(current.keySet());
        names.removeIf(name -> Objects.equals(asked.get(name), current.get(name)));
        return names;
    }

    /** Defaults filled in, so that members that a context broker adds make no difference. */
    private static Map<String, Object> subject(JsonNode subscription) {
        JsonNode subject = subscription.path("subject");
        Set<Map<String, String>> entities = new java.util.HashSet<>();
        subject.path("entities").forEach(entity -> entities.add(texts(entity)));
        JsonNode condition = subject.path("condition");
        Map<String, Object> view = new LinkedHashMap<>();
        view.put("entities", entities);
        view.put("condition.attrs", list(condition.path("attrs")));
        view.put("alterationTypes", new TreeSet<>(list(condition.path("alterationTypes"))));
        view.put("expression", texts(condition.path("expression")));
        return view;
    }

    private static Map<String, Object> notification(JsonNode subscription) {
        JsonNode notification = subscription.path("notification");
        boolean custom = notification.has("httpCustom");
        JsonNode target = notification.path(custom ? "httpCustom" : "http");
        Map<String, Object> view = new LinkedHashMap<>();
        view.put("url", target.path("url").asText());
        view.put("headers", texts(target.path("headers")));
        view.put("attrs", list(notification.path("attrs")));
        view.put("exceptAttrs", list(notification.path("exceptAttrs")));
        view.put("metadata", list(notification.path("metadata")));
        view.put("attrsFormat", notification.path("attrsFormat").asText("normalized"));
        view.put("onlyChangedAttrs", notification.path("onlyChangedAttrs").asBoolean(false));
        view.put("maxFailsLimit", notification.path("maxFailsLimit").asInt(0));
        view.put("payload", target.hasNonNull("payload") || target.has("json") || target.has("ngsi"));
        return view;
    }

    private static Map<String, String> texts(JsonNode object) {
        Map<String, String> texts = new TreeMap<>();
        object.properties().forEach(member -> {
            if (!member.getValue().asText().isEmpty()) {
                texts.put(member.getKey(), member.getValue().asText());
            }
        });
        return texts;
    }

    private static List<String> list(JsonNode array) {
        List<String> list = new ArrayList<>();
        array.forEach(one -> list.add(one.asText()));
        return list;
    }

    private static String url(JsonNode subscription) {
        return (String) notification(subscription).get("url");
    }

    static String id(JsonNode subscription) {
        return subscription.path("id").asText();
    }

    private static String description(JsonNode subscription) {
        return subscription.path("description").asText();
    }
}
