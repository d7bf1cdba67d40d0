package io.furrow.control.alarm;

import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.Entity;

/**
 * What a record of {@code data.temperature} says of a field.
 *
 * @param average null where there was nothing to average
 * @param suspects ids of the entities that were set aside
 * @param windowStart epoch ms
 * @param windowEnd epoch ms
 * @param domain null where the field belongs to none
 * @param verified whether there were enough devices to tell which are suspects
 */
public record FieldWindow(
        String field,
        Double average,
        List<String> suspects,
        long windowStart,
        long windowEnd,
        String domain,
        boolean verified) {
    public static final String TYPE = "Analytics:FieldTemperature";

    /** Null where it is of something else, as a device that was set aside. */
    public static FieldWindow of(Entity entity) {
        String field = entity.text("field").orElse(null);
        if (!entity.type().equals(TYPE) || field == null) {
            return null;
        }
        List<String> suspects = new ArrayList<>();
        for (JsonNode each :
                entity.value("suspects").map(list -> (Iterable<JsonNode>) list).orElse(List.of())) {
            suspects.add(each.asText());
        }
        return new FieldWindow(
                field,
                entity.number("averageTemperature").orElse(null),
                suspects,
                entity.number("windowStart").orElse(0.0).longValue(),
                entity.number("windowEnd").orElse(0.0).longValue(),
                entity.text("Domain").orElse(null),
                !entity.text("quality").orElse("").equals("unverified"));
    }
}
