package io.furrow.control.alarm.watch;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.result.FieldResult;

/**
 * The window of a field from a record of {@code data.temperature}.
 *
 * @param average null if there was nothing to average
 * @param suspects the excluded entities
 * @param windowStart epoch ms
 * @param windowEnd epoch ms
 * @param domain null if the field belongs to none
 * @param verified whether there were enough devices to identify suspects
 */
public record FieldWindow(
        String field,
        Double average,
        List<Suspect> suspects,
        long windowStart,
        long windowEnd,
        String domain,
        boolean verified) {
    /** @param type empty if the record does not name it */
    public record Suspect(String id, String type) {
        /** Returns a key that is unique within the field's tenant and path; the length makes it unambiguous. */
        public String key() {
            return type.isEmpty() ? id : type.length() + ":" + type + id;
        }
    }

    /** Returns null if the entity is of another type, such as an excluded device. */
    public static FieldWindow of(Entity entity) {
        String field = entity.text(FieldResult.FIELD).orElse(null);
        if (!entity.type().equals(FieldResult.TEMPERATURE_TYPE) || field == null) {
            return null;
        }
        JsonNode ids = entity.value(FieldResult.SUSPECTS).orElse(MissingNode.getInstance());
        JsonNode types = entity.value(FieldResult.SUSPECT_TYPES).orElse(MissingNode.getInstance());
        List<Suspect> suspects = new ArrayList<>();
        for (int i = 0; i < ids.size(); i++) {
            suspects.add(new Suspect(ids.path(i).asText(), types.path(i).asText()));
        }
        return new FieldWindow(
                field,
                entity.number(FieldResult.AVERAGE_TEMPERATURE).orElse(null),
                suspects,
                entity.number(FieldResult.WINDOW_START).orElse(0.0).longValue(),
                entity.number(FieldResult.WINDOW_END).orElse(0.0).longValue(),
                entity.text("Domain").orElse(null),
                !entity.text(FieldResult.QUALITY).orElse("").equals(FieldResult.UNVERIFIED));
    }
}
