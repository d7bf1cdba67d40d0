package io.furrow.model.ngsi;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * What a context broker sent in one piece: the entities that could be read, and why the others could not.
 *
 * @param entities in the order of the notification
 * @param rejected one per unreadable entity; the others of the same notification are not harmed
 */
public record Notification(List<Entity> entities, List<UnreadableException> rejected) {
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
        if (!root.has("data")) {
            return new Notification(List.of(readEntity(root, attrsFormat)), List.of());
        }
        if (!root.isObject() || !root.get("data").isArray()) {
            throw new UnreadableException(Reason.NOT_AN_ENTITY, "'data' is no array of entities");
        }
        return readAll(root.get("data"), attrsFormat);
    }

    private static Notification readAll(JsonNode data, String attrsFormat) {
        List<Entity> entities = new ArrayList<>(data.size());
        List<UnreadableException> rejected = new ArrayList<>();
        for (JsonNode reported : data) {
            try {
                entities.add(readEntity(reported, attrsFormat));
            } catch (UnreadableException e) {
                rejected.add(e);
            }
        }
        return new Notification(List.copyOf(entities), List.copyOf(rejected));
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
