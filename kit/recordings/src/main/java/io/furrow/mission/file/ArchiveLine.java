package io.furrow.mission.file;

import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Encodes events as lines of JSON: {@code {"id", "time", "headers", "entity"}} with the event id, the event time in
 * epoch ms, the record's headers and the reported entity. A deletion has {@code "entity": null} and {@code entityId}.
 * The same event always produces the same line.
 */
public final class ArchiveLine {
    private static final JsonNodeFactory NODES = new JsonNodeFactory(true);

    private ArchiveLine() {}

    /** Returns the line without a line break. */
    public static byte[] write(StoredEvent event) {
        ObjectNode line = NODES.objectNode();
        line.put("id", event.id());
        line.put("time", event.time());
        ObjectNode headers = line.putObject("headers");
        new TreeMap<>(event.headers()).forEach(headers::put);
        if (event.entity() == null) {
            line.put("entityId", event.entityId());
        }
        line.set("entity", event.entity());
        return NgsiJson.write(line);
    }

    /**
     * @throws UnreadableException with {@link Reason#NOT_JSON} or {@link Reason#NOT_AN_EVENT}
     */
    public static StoredEvent read(String text) throws UnreadableException {
        JsonNode line = NgsiJson.read(text.getBytes(StandardCharsets.UTF_8));
        JsonNode entity = line.path("entity");
        JsonNode entityId = entity.isNull() ? line.path("entityId") : entity.path("id");
        boolean complete = line.path("id").isTextual()
                && line.path("time").canConvertToLong()
                && line.path("headers").isObject()
                && (entity.isNull() || entity.isObject())
                && entityId.isTextual();
        Reason.NOT_AN_EVENT.refuseIf(
                !complete, "it lacks one of id, time, headers and entity (or entityId of a deletion)");
        Map<String, String> headers = new TreeMap<>();
        line.get("headers")
                .properties()
                .forEach(
                        header -> headers.put(header.getKey(), header.getValue().asText()));
        return new StoredEvent(
                line.get("id").textValue(),
                line.get("time").longValue(),
                entityId.textValue(),
                headers,
                entity.isNull() ? null : (ObjectNode) entity);
    }
}
