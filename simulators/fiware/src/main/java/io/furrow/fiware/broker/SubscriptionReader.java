package io.furrow.fiware.broker;

import java.net.URI;
import java.net.URISyntaxException;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.EnumSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.SubscriptionDefinition.Limits;
import io.furrow.fiware.broker.SubscriptionDefinition.Selector;
import io.furrow.fiware.broker.SubscriptionDefinition.Subject;
import io.furrow.fiware.broker.SubscriptionDefinition.Target;
import io.furrow.fiware.http.NgsiError;

/**
 * Reads {@code POST /v2/subscriptions}. Refuses options of Orion that the stand-in lacks by name; ignores unknown ones,
 * as Orion does.
 */
public final class SubscriptionReader {
    private static final Set<String> NOTIFICATION_UNSUPPORTED =
            Set.of("mqtt", "mqttCustom", "kafka", "kafkaCustom", "exceptAttrs");
    private static final Set<String> TARGET_UNSUPPORTED = Set.of("qs", "method", "payload", "json", "ngsi");

    private SubscriptionReader() {}

    public static SubscriptionDefinition read(JsonNode json) throws NgsiError {
        if (!json.isObject()) {
            throw NgsiError.badRequest("subscription is not a JSON object");
        }
        Subject subject = subject(required(json, "subject"));
        JsonNode notification = required(json, "notification");
        refuse(NOTIFICATION_UNSUPPORTED, notification, "notification");
        if (notification.path("covered").asBoolean(false)) {
            throw NgsiError.unsupported("notification with 'covered'");
        }
        return new SubscriptionDefinition(
                subject,
                target(notification),
                rendering(notification),
                notification.path("onlyChangedAttrs").asBoolean(false),
                limits(json, notification),
                shown(json));
    }

    private static Subject subject(JsonNode json) throws NgsiError {
        List<Selector> selectors = new ArrayList<>();
        for (JsonNode entity : json.path("entities")) {
            if (entity.has("id") == entity.has("idPattern")) {
                throw NgsiError.badRequest("subject entities: exactly one of id and idPattern is needed");
            }
            selectors.add(new Selector(matcher(entity, "id", "idPattern"), matcher(entity, "type", "typePattern")));
        }
        if (selectors.isEmpty()) {
            throw NgsiError.badRequest("no subject entities specified");
        }
        JsonNode condition = json.path("condition");
        if (!condition.path("notifyOnMetadataChange").asBoolean(true)) {
            throw NgsiError.unsupported("condition with 'notifyOnMetadataChange' false");
        }
        for (String unsupported : List.of("attrs", "expression")) {
            if (!condition.path(unsupported).isEmpty()) {
                throw NgsiError.unsupported("condition with '" + unsupported + "'");
            }
        }
        return new Subject(selectors, kinds(condition));
    }

    private static Predicate<String> matcher(JsonNode entity, String exact, String pattern) throws NgsiError {
        if (entity.has(exact)) {
            return entity.get(exact).asText()::equals;
        }
        return entity.has(pattern) ? SyntaxRules.pattern(entity.get(pattern).asText()) : any -> true;
    }

    private static Set<EntityChange.Kind> kinds(JsonNode condition) throws NgsiError {
        if (!condition.has("alterationTypes")) {
            return EnumSet.of(EntityChange.Kind.CREATE, EntityChange.Kind.CHANGE);
        }
        Set<EntityChange.Kind> kinds = EnumSet.noneOf(EntityChange.Kind.class);
        for (String name : texts(condition, "alterationTypes")) {
            switch (name) {
                case "entityCreate" -> kinds.add(EntityChange.Kind.CREATE);
                case "entityChange" -> kinds.add(EntityChange.Kind.CHANGE);
                case "entityUpdate" -> kinds.addAll(EnumSet.of(EntityChange.Kind.CHANGE, EntityChange.Kind.UPDATE));
                case "entityDelete" -> kinds.add(EntityChange.Kind.DELETE);
                default -> throw NgsiError.badRequest("unknown alterationType: " + name);
            }
        }
        return kinds;
    }

    private static Target target(JsonNode notification) throws NgsiError {
        if (notification.has("http") == notification.has("httpCustom")) {
            throw NgsiError.badRequest("exactly one of http and httpCustom is needed");
        }
        JsonNode json = notification.has("http") ? notification.get("http") : notification.get("httpCustom");
        refuse(TARGET_UNSUPPORTED, json, "http notification");
        Map<String, String> headers = new LinkedHashMap<>();
        json.path("headers")
                .properties()
                .forEach(
                        header -> headers.put(header.getKey(), header.getValue().asText("")));
        String url = json.path("url").asText();
        if (url.contains("${") || headers.toString().contains("${")) {
            throw NgsiError.unsupported("macros in httpCustom");
        }
        return new Target(
                url(url), headers, Duration.ofMillis(json.path("timeout").asLong(5000)));
    }

    private static URI url(String text) throws NgsiError {
        try {
            URI url = new URI(text);
            if (url.getHost() != null && ("http".equals(url.getScheme()) || "https".equals(url.getScheme()))) {
                return url;
            }
        } catch (URISyntaxException e) {
            throw NgsiError.badRequest("Invalid URL parsing notification url: " + e.getMessage());
        }
        throw NgsiError.badRequest("Invalid URL parsing notification url");
    }

    private static Rendering rendering(JsonNode json) throws NgsiError {
        String name = json.path("attrsFormat").asText("normalized");
        for (Rendering.Format format : Rendering.Format.values()) {
            if (format.label().equals(name)) {
                return new Rendering(texts(json, "attrs"), texts(json, "metadata"), format);
            }
        }
        throw NgsiError.badRequest("invalid attrsFormat, accepted values: normalized, simplifiedNormalized, "
                + "keyValues, simplifiedkeyValues, values"); // spelled as Orion does
    }

    private static Limits limits(JsonNode json, JsonNode notification) throws NgsiError {
        String status = json.path("status").asText("active");
        if (!status.equals("active") && !status.equals("inactive")) {
            throw NgsiError.badRequest("status is not valid: it has to be either active or inactive");
        }
        String expires = json.path("expires").asText("");
        Optional<Instant> end = NgsiTime.parse(expires);
        if (!expires.isEmpty() && end.isEmpty()) {
            throw NgsiError.badRequest("expires has an invalid format");
        }
        Optional<Integer> maxFails = notification.has("maxFailsLimit")
                ? Optional.of(notification.get("maxFailsLimit").asInt())
                : Optional.empty();
        Duration throttling = Duration.ofSeconds(json.path("throttling").asLong(0));
        return new Limits(status.equals("active"), end, throttling, maxFails);
    }

    /** JSON for {@code GET}: known members, with defaults. */
    private static ObjectNode shown(JsonNode json) {
        ObjectNode shown = copy(json, List.of("description", "expires", "throttling"));
        if (shown.path("expires").asText("").isEmpty()) {
            shown.remove("expires");
        }
        if (shown.path("throttling").asLong() <= 0) {
            shown.remove("throttling");
        }
        ObjectNode subject = shown.putObject("subject");
        json.at("/subject/entities")
                .forEach(entity -> subject.withArray("entities")
                        .add(copy(entity, List.of("id", "idPattern", "type", "typePattern"))));
        JsonNode condition = json.at("/subject/condition");
        ObjectNode conditionShown = copy(condition, List.of("attrs", "alterationTypes"));
        if (!conditionShown.has("attrs")) {
            conditionShown.putArray("attrs");
        }
        subject.set("condition", conditionShown.put("notifyOnMetadataChange", true));
        shown.set("notification", notification(json.path("notification")));
        return shown;
    }

    private static ObjectNode notification(JsonNode json) {
        ObjectNode shown = copy(json, List.of("http", "httpCustom", "attrs", "metadata", "maxFailsLimit"));
        if (!shown.has("attrs")) {
            shown.putArray("attrs");
        }
        return shown.put("onlyChangedAttrs", json.path("onlyChangedAttrs").asBoolean(false))
                .put("attrsFormat", json.path("attrsFormat").asText("normalized"))
                .put("covered", false);
    }

    private static ObjectNode copy(JsonNode json, List<String> members) {
        ObjectNode copy = JsonNodeFactory.instance.objectNode();
        for (String member : members) {
            if (json.has(member)) {
                copy.set(member, json.get(member).deepCopy());
            }
        }
        return copy;
    }

    private static JsonNode required(JsonNode json, String field) throws NgsiError {
        if (!json.path(field).isContainerNode()) {
            throw NgsiError.badRequest("no " + field + " in the subscription");
        }
        return json.get(field);
    }

    private static List<String> texts(JsonNode json, String field) {
        List<String> texts = new ArrayList<>();
        json.path(field).forEach(text -> texts.add(text.asText()));
        return List.copyOf(texts);
    }

    private static void refuse(Set<String> unsupported, JsonNode json, String what) throws NgsiError {
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (unsupported.contains(member.getKey())) {
                throw NgsiError.unsupported(what + " with '" + member.getKey() + "'");
            }
        }
    }
}
