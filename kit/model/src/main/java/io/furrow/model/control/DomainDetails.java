package io.furrow.model.control;

import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.FieldVersion;

/**
 * Details of a domain; null for those that a request omits.
 *
 * @param name for people
 * @param area valid GeoJSON of a Polygon or MultiPolygon
 * @param fields ids of fields, see {@link FieldVersion}
 */
public record DomainDetails(String name, String description, ObjectNode area, List<String> fields) {
    /** No details. */
    public static final DomainDetails NONE = new DomainDetails(null, null, null, null);

    /** Returns these details, completed by others. */
    public DomainDetails over(DomainDetails others) {
        return new DomainDetails(
                name == null ? others.name : name,
                description == null ? others.description : description,
                area == null ? others.area : area,
                fields == null ? others.fields : fields);
    }

    static DomainDetails read(JsonObjectReader members) throws RejectedException {
        ObjectNode area = members.objectOrNull("area");
        if (area != null) {
            JsonObjectReader.checkArea(area, "'area'");
        }
        return new DomainDetails(
                members.textOrNull("name"),
                members.textOrNull("description"),
                area,
                members.has("fields") ? members.texts("fields", FieldVersion.ID, "ids of fields") : null);
    }
}
