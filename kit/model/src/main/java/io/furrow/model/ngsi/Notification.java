package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What a context broker sent in one piece: the entities that could be read, and why the others could not.
 *
 * @param subscriptionId empty if the form does not name it
 * @param entities in the order of the notification
 * @param places of the entities among all that were reported, unreadable ones included, from 0
 * @param rejected one per unreadable entity, at most {@value #MAX_REJECTED}; the others of the same notification are not harmed
 */
public record Notification(
        Optional<String> subscriptionId, List<Entity> entities, List<Integer> places, List<Rejected> rejected) {
    /** A notification with more unreadable entities than this is unreadable as a whole. */
    static final int MAX_REJECTED = 1000;

    /** One unreadable entity as it was reported, and why it could not be read. */
    public record Rejected(JsonNode reported, Reason reason, String message) {}

    /**
     * Reads a notification in any form that names its attributes. NGSI-v2: {@code normalized} and {@code keyValues}
     * ({@code {subscriptionId, data: [entity…]}}), {@code simplifiedNormalized} and {@code simplifiedKeyValues} (the bare
     * entity). NGSI-LD: {@code {"type": "Notification", subscriptionId, data}}, where data is a list of entities or a GeoJSON
     * {@code FeatureCollection}, or the bare entity; normalized, concise or simplified, see {@link NgsiLdEntity}.
     *
     * @param attrsFormat header {@code Ngsiv2-AttrsFormat}, which NGSI-LD has not, or null: then the form is reported from the
     *     shape
     * @throws UnreadableException if nothing in the body can be understood, or more than {@value #MAX_REJECTED} of its entities cannot
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

    /** How many entities were reported, unreadable ones included. */
    public int size() {
        return entities.size() + rejected.size();
    }

    /** An NGSI-v2 entity may be called Notification too, but it has no list called data. */
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

    /** How one entity of a notification is read. */
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
