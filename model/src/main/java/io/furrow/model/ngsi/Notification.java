package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What a context broker sent in one piece: the entities that could be read, and why the others could not.
 *
 * @param subscriptionId empty where the form does not name it
 * @param entities in the order of the notification
 * @param rejected one per unreadable entity; the others of the same notification are not harmed
 */
public record Notification(Optional<String> subscriptionId, List<Entity> entities, List<Rejected> rejected) {
    /** One unreadable entity as it was reported, and why it could not be read. */
    public record Rejected(JsonNode reported, Reason reason, String message) {}

    /**
     * Reads an NGSI-v2 notification in any form that names its attributes: {@code normalized} and {@code keyValues}
     * ({@code {subscriptionId, data: [entity…]}}), {@code simplifiedNormalized} and {@code simplifiedKeyValues} (the bare
     * entity).
     *
     * @param attrsFormat header {@code Ngsiv2-AttrsFormat}, or null: then the form is told from the shape
     * @throws UnreadableException if nothing in the body can be understood
     */
    public static Notification read(byte[] body, String attrsFormat) throws UnreadableException {
        JsonNode root = NgsiJson.read(body);
        if ("values".equals(attrsFormat)) {
            throw new UnreadableException(
                    Reason.UNSUPPORTED_FORM,
                    "form 'values' does not name its attributes; set the subscription's attrsFormat to normalized");
        }
        boolean simplified = attrsFormat != null && attrsFormat.startsWith("simplified");
        if (simplified || root.has("id") || !root.has("data")) {
            return new Notification(Optional.empty(), List.of(readEntity(root, attrsFormat)), List.of());
        }
        if (!root.isObject() || !root.get("data").isArray()) {
            throw new UnreadableException(Reason.NOT_AN_ENTITY, "'data' is no array of entities");
        }
        Optional<String> subscription =
                Optional.ofNullable(root.path("subscriptionId").textValue());
        return readAll(subscription, root.get("data"), attrsFormat);
    }

    private static Notification readAll(Optional<String> subscription, JsonNode data, String attrsFormat) {
        List<Entity> entities = new ArrayList<>(data.size());
        List<Rejected> rejected = new ArrayList<>();
        for (JsonNode reported : data) {
            try {
                entities.add(readEntity(reported, attrsFormat));
            } catch (UnreadableException e) {
                rejected.add(new Rejected(reported, e.reason(), e.getMessage()));
            }
        }
        return new Notification(subscription, List.copyOf(entities), List.copyOf(rejected));
    }

    private static Entity readEntity(JsonNode reported, String attrsFormat) throws UnreadableException {
        EntityForm form = attrsFormat == null
                ? EntityForm.of(reported)
                : switch (attrsFormat) {
                    case "keyValues", "simplifiedKeyValues" -> EntityForm.KEY_VALUES;
                    case "normalized", "simplifiedNormalized" -> EntityForm.NORMALIZED;
                    default -> EntityForm.of(reported);
                };
        return form.read(reported);
    }
}
