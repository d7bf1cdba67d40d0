package io.furrow.simulators.fiware;

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
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.simulators.fiware.SubscriptionDefinition.Limits;
import io.furrow.simulators.fiware.SubscriptionDefinition.Selector;
import io.furrow.simulators.fiware.SubscriptionDefinition.Subject;
import io.furrow.simulators.fiware.SubscriptionDefinition.Target;

/** Reads {@code POST /v2/subscriptions}; an option that the stand-in does not have is refused, never ignored. */
final class SubscriptionReader {
    private static final Set<String> FIELDS =
            Set.of("description", "subject", "notification", "expires", "status", "throttling");
    private static final Set<String> SUBJECT_FIELDS = Set.of("entities", "condition");
    private static final Set<String> SELECTOR_FIELDS = Set.of("id", "idPattern", "type", "typePattern");
    private static final Set<String> CONDITION_FIELDS = Set.of("attrs", "expression", "alterationTypes");
    private static final Set<String> NOTIFICATION_FIELDS = Set.of(
            "http",
            "httpCustom",
            "attrs",
            "exceptAttrs",
            "attrsFormat",
            "metadata",
            "onlyChangedAttrs",
            "maxFailsLimit");
    private static final Set<String> TARGET_FIELDS = Set.of("url", "headers", "timeout");

    private SubscriptionReader() {}

    static SubscriptionDefinition read(JsonNode json) throws NgsiError {
        only(FIELDS, json, "subscription");
        JsonNode notification = required(json, "notification");
        only(NOTIFICATION_FIELDS, notification, "notification");
        return new SubscriptionDefinition(
                subject(required(json, "subject")),
                target(notification),
                rendering(notification),
                notification.path("onlyChangedAttrs").asBoolean(false),
                limits(json, notification),
                shown(json));
    }

    private static Subject subject(JsonNode json) throws NgsiError {
        only(SUBJECT_FIELDS, json, "subject");
        List<Selector> selectors = new ArrayList<>();
        for (JsonNode entity : required(json, "entities")) {
            only(SELECTOR_FIELDS, entity, "subject.entities");
            if (entity.has("id") == entity.has("idPattern")) {
                throw NgsiError.badRequest("subject entities: exactly one of id and idPattern is needed");
            }
            selectors.add(new Selector(matcher(entity, "id", "idPattern"), matcher(entity, "type", "typePattern")));
        }
        if (selectors.isEmpty()) {
            throw NgsiError.badRequest("subject entities is empty");
        }
        JsonNode condition = json.path("condition");
        only(CONDITION_FIELDS, condition, "condition");
        JsonNode expression = condition.path("expression");
        only(Set.of("q"), expression, "condition.expression");
        Optional<QueryFilter> filter = expression.has("q")
                ? Optional.of(QueryFilter.parse(expression.get("q").asText()))
                : Optional.empty();
        return new Subject(selectors, Set.copyOf(texts(condition, "attrs")), filter, kinds(condition));
    }

    private static Predicate<String> matcher(JsonNode entity, String exact, String pattern) throws NgsiError {
        if (entity.has(exact)) {
            return entity.get(exact).asText()::equals;
        }
        return entity.has(pattern) ? QueryFilter.pattern(entity.get(pattern).asText()) : any -> true;
    }

    private static Set<Change.Kind> kinds(JsonNode condition) throws NgsiError {
        if (!condition.has("alterationTypes")) {
            return EnumSet.of(Change.Kind.CREATE, Change.Kind.CHANGE);
        }
        Set<Change.Kind> kinds = EnumSet.noneOf(Change.Kind.class);
        for (String name : texts(condition, "alterationTypes")) {
            switch (name) {
                case "entityCreate" -> kinds.add(Change.Kind.CREATE);
                case "entityChange" -> kinds.add(Change.Kind.CHANGE);
                case "entityUpdate" -> kinds.addAll(EnumSet.of(Change.Kind.CHANGE, Change.Kind.UPDATE));
                case "entityDelete" -> kinds.add(Change.Kind.DELETE);
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
        only(TARGET_FIELDS, json, "http notification");
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
        if (json.has("attrs") && json.has("exceptAttrs")) {
            throw NgsiError.badRequest("http notification has both attrs and exceptAttrs");
        }
        String name = json.path("attrsFormat").asText("normalized");
        for (Rendering.Format format : Rendering.Format.values()) {
            if (format.label().equals(name) && format != Rendering.Format.UNIQUE) {
                return new Rendering(
                        texts(json, "attrs"), Set.copyOf(texts(json, "exceptAttrs")), texts(json, "metadata"), format);
            }
        }
        throw NgsiError.badRequest("invalid attrsFormat, accepted values: normalized, keyValues, values, "
                + "simplifiedNormalized, simplifiedKeyValues");
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

    private static ObjectNode shown(JsonNode json) {
        ObjectNode shown = ((ObjectNode) json.deepCopy());
        shown.remove("status");
        if (shown.path("expires").asText("").isEmpty()) {
            shown.remove("expires");
        }
        ObjectNode subject = (ObjectNode) shown.get("subject");
        if (!subject.has("condition")) {
            subject.putObject("condition");
        }
        ObjectNode condition = (ObjectNode) subject.get("condition");
        if (!condition.has("attrs")) {
            condition.putArray("attrs");
        }
        ObjectNode notification = (ObjectNode) shown.get("notification");
        if (!notification.has("attrs") && !notification.has("exceptAttrs")) {
            notification.putArray("attrs");
        }
        if (!notification.has("onlyChangedAttrs")) {
            notification.put("onlyChangedAttrs", false);
        }
        if (!notification.has("attrsFormat")) {
            notification.put("attrsFormat", "normalized");
        }
        return shown;
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

    private static void only(Set<String> known, JsonNode json, String what) throws NgsiError {
        if (!json.isObject() && !json.isMissingNode()) {
            throw NgsiError.badRequest(what + " is not a JSON object");
        }
        for (Map.Entry<String, JsonNode> member : json.properties()) {
            if (!known.contains(member.getKey())) {
                throw NgsiError.unsupported(what + " with '" + member.getKey() + "'");
            }
        }
    }
}
