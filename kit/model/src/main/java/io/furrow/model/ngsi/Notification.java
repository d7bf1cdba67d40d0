package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * A notification of a context broker: the readable entities, and why the others were rejected.
 *
 * @param subscriptionId empty if the representation does not contain it
 * @param entities in the order of the notification
 * @param places positions of the entities among all reported ones, including unreadable ones, from 0
 * @param rejected one per unreadable entity, at most {@value #MAX_REJECTED}; the others of the notification are
 * accepted
 */
public record Notification(
        Optional<String> subscriptionId, List<Entity> entities, List<Integer> places, List<Rejected> rejected) {
    /** A notification with more unreadable entities than this is unreadable as a whole. */
    static final int MAX_REJECTED = 1000;

    /** An unreadable entity as reported, and the reason. */
    public record Rejected(JsonNode reported, Reason reason, String message) {}

    /**
     * Reads a notification in any representation that names its attributes. NGSI-v2: {@code normalized} and {@code
     * keyValues} ({@code {subscriptionId, data: [entity…]}}), {@code simplifiedNormalized} and {@code
     * simplifiedKeyValues} (the bare entity). NGSI-LD: {@code {"type": "Notification", subscriptionId, data}}, where
     * data is a list of entities or a GeoJSON {@code FeatureCollection}, or the bare entity; normalized, concise or
     * simplified, see {@link NgsiLdEntity}.
     *
     * @param attrsFormat header {@code Ngsiv2-AttrsFormat}, which NGSI-LD does not have; null to detect the
     * representation by its shape
     * @throws UnreadableException if the body as a whole is unreadable, or more than {@value #MAX_REJECTED} of its
     * entities are
     */
    public static Notification read(byte[] body, String attrsFormat) throws UnreadableException {
        JsonNode root = NgsiJson.read(body);
        Reason.UNSUPPORTED_FORM.refuseIf(
                root.path("contextResponses").isArray(),
                "form 'legacy' is that of NGSIv1, which is not read; set the subscription's attrsFormat to normalized");
        Reason.UNSUPPORTED_FORM.refuseIf(
                "values".equals(attrsFormat) || !root.has("id") && isListOfLists(root.path("data")),
                "form 'values' does not name its attributes; set the subscription's attrsFormat to normalized");
        if (isLinkedData(root)) {
            return readLinkedData(root);
        }
        boolean simplified = attrsFormat != null && attrsFormat.startsWith("simplified");
        if (simplified || root.has("id") || !root.has("data")) {
            return new Notification(Optional.empty(), List.of(readEntity(root, attrsFormat)), List.of(0), List.of());
        }
        Reason.NOT_AN_ENTITY.refuseIf(
                !root.isObject() || !root.get("data").isArray(), "'data' is not an array of entities");
        Optional<String> subscription =
                Optional.ofNullable(root.path("subscriptionId").textValue());
        return readAll(subscription, root.get("data"), entity -> readEntity(entity, attrsFormat));
    }

    /** Returns the number of reported entities, including unreadable ones. */
    public int size() {
        return entities.size() + rejected.size();
    }

    /** Returns whether it is an NGSI-LD notification; an NGSI-v2 entity of that type has no list as data. */
    private static boolean isLinkedData(JsonNode root) {
        return "Notification".equals(root.path("type").textValue())
                && NgsiLdEntity.members(root.path("data")).isPresent();
    }

    private static Notification readLinkedData(JsonNode root) throws UnreadableException {
        List<JsonNode> data = NgsiLdEntity.members(root.get("data")).orElseThrow();
        Optional<String> subscription =
                Optional.ofNullable(root.path("subscriptionId").textValue());
        return readAll(subscription, data, NgsiLdEntity::read);
    }

    /** Reads one entity of a notification. */
    private interface EntityReader {
        Entity read(JsonNode reported) throws UnreadableException;
    }

    private static Notification readAll(Optional<String> subscription, Iterable<JsonNode> data, EntityReader reader)
            throws UnreadableException {
        List<Entity> entities = new ArrayList<>();
        List<Integer> places = new ArrayList<>();
        List<Rejected> rejected = new ArrayList<>();
        for (JsonNode reported : data) {
            try {
                entities.add(reader.read(reported));
                places.add(places.size() + rejected.size());
            } catch (UnreadableException e) {
                if (rejected.size() == MAX_REJECTED) {
                    throw new UnreadableException(
                            e.reason(),
                            "more than " + MAX_REJECTED + " entities cannot be read; here, " + e.getMessage());
                }
                rejected.add(new Rejected(reported, e.reason(), e.getMessage()));
            }
        }
        return new Notification(subscription, List.copyOf(entities), List.copyOf(places), List.copyOf(rejected));
    }

    private static boolean isListOfLists(JsonNode data) {
        return !data.isEmpty() && data.valueStream().allMatch(JsonNode::isArray);
    }

    private static Entity readEntity(JsonNode reported, String attrsFormat) throws UnreadableException {
        if (attrsFormat == null) {
            return Entity.ofAnyForm(reported);
        }
        NgsiV2Representation form = switch (attrsFormat) {
            case "keyValues", "simplifiedKeyValues" -> NgsiV2Representation.KEY_VALUES;
            case "normalized", "simplifiedNormalized" -> NgsiV2Representation.NORMALIZED;
            default -> NgsiV2Representation.of(reported);
        };
        return form.read(reported);
    }
}
