package io.furrow.model.control;

import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.StateJson;

/**
 * Details of a domain; null for those that a request omits.
 *
 * @param name for people
 * @param area valid GeoJSON of a Polygon or MultiPolygon
 * @param fields ids of fields, see {@link FieldVersion}
 */
public record DomainDetails(String name, String description, ObjectNode area, List<String> fields) {
    private static final List<String> MEMBERS = List.of("name", "description", "area", "fields");

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

    /** Returns the details among the members of a request, nulls included. */
    static ObjectNode members(ObjectNode request) {
        return request.deepCopy().retain(MEMBERS);
    }

    /**
     * Returns these details merged with a patch, as RFC 7396 defines it. The {@code bbox} of an area goes with its old
     * coordinates.
     *
     * @param patch null removes a member
     * @throws RejectedException if the result is not valid
     */
    public DomainDetails patched(ObjectNode patch) throws RejectedException {
        ObjectNode merged = StateJson.tree(this);
        if (patch.path("area").has("coordinates") && merged.get("area") instanceof ObjectNode old) {
            old.remove("bbox");
        }
        merge(merged, patch);
        return read(new JsonObjectReader(merged));
    }

    private static void merge(ObjectNode target, ObjectNode patch) {
        patch.properties().forEach(member -> {
            String name = member.getKey();
            if (member.getValue() instanceof ObjectNode inner) {
                merge(target.get(name) instanceof ObjectNode existing ? existing : target.putObject(name), inner);
            } else if (member.getValue().isNull()) {
                target.remove(name);
            } else {
                target.set(name, member.getValue());
            }
        });
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
