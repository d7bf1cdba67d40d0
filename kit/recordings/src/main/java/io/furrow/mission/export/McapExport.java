package io.furrow.mission.export;

import java.io.IOException;
import java.io.OutputStream;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.mission.StoredEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Exports MCAP, for tools such as Foxglove: a schema for each entity type, a channel {@code <type>/<entity id>} for
 * each entity, a message for each event with its time in nanoseconds and the entity as JSON; {@code {"id", "deleted":
 * true}} for a deletion. The channel {@code markers} has the markers of the mission, if there are any.
 */
public final class McapExport implements MissionExport {
    private static final String NO_TIME = "MCAP has no times before 1970 or after 2554";

    static final long NANOS = 1_000_000;
    /** The last time in unsigned 64-bit nanoseconds, in 2554. */
    static final long LAST_MILLIS = Long.divideUnsigned(-1L, NANOS);

    @Override
    public ExportResult write(Source mission, OutputStream out, LongConsumer progress) throws IOException {
        McapWriter file = new McapWriter(out, "furrow");
        McapMarkers markers = new McapMarkers(mission, file);
        Channels channels = new Channels(mission.name(), file);
        ExportResult exportResult = new Exporter(progress).over(mission.recording(), event -> {
            markers.writeUntil(event.time());
            return channels.write(event);
        });
        markers.writeUntil(LAST_MILLIS);
        file.finish();
        return markers.remaining() == 0
                ? exportResult
                : new ExportResult(
                        exportResult.events(),
                        exportResult.leftOut() + markers.remaining(),
                        exportResult.example().or(() -> Optional.of("a marker: " + NO_TIME)));
    }

    static ObjectNode emptySchema(String title) {
        ObjectNode schema = NgsiJson.object();
        schema.put("$schema", "https://json-schema.org/draft/2020-12/schema");
        return schema.put("title", title).put("type", "object");
    }

    /** The channels and schemas of one file of entities. */
    private static final class Channels {
        private final String mission;
        private final McapWriter file;
        private final Map<String, Integer> schemas = new HashMap<>();
        /** Keys are identity and type. */
        private final Map<String, Integer> byEntity = new HashMap<>();
        /** Types by tenant, service path and id, for deletions without a type. */
        private final Map<String, String> types = new HashMap<>();

        Channels(String mission, McapWriter file) {
            this.mission = mission;
            this.file = file;
        }

        Optional<String> write(StoredEvent event) throws IOException {
            if (event.time() < 0 || event.time() > LAST_MILLIS) {
                return Optional.of(NO_TIME);
            }
            FiwareScope scope = FiwareScope.of(event.headers());
            String identity = scope.identity(event.entityId());
            String type = event.entity() == null
                    ? event.headers().getOrDefault(HeaderNames.ENTITY_TYPE, types.getOrDefault(identity, "Thing"))
                    : event.entity().path("type").asText("Thing");
            types.put(identity, type);
            String key = type + "|" + identity;
            Integer channel = byEntity.get(key);
            if (channel == null) {
                if (file.channels() == McapWriter.MAX_CHANNELS) {
                    return Optional.of("MCAP has no more than 65,535 channels, and each entity takes one");
                }
                channel = channel(type, event.entityId(), scope);
                byEntity.put(key, channel);
            }
            ObjectNode data = event.entity() == null
                    ? NgsiJson.object().put("id", event.entityId()).put("deleted", true)
                    : event.entity();
            file.message(channel, event.time() * NANOS, NgsiJson.write(data));
            return Optional.empty();
        }

        private int channel(String type, String entityId, FiwareScope scope) {
            Integer schema = schemas.get(type);
            if (schema == null) {
                schema = file.schema(type, "jsonschema", NgsiJson.write(schemaOf(type)));
                schemas.put(type, schema);
            }
            TreeMap<String, String> metadata = new TreeMap<>(Map.of(
                    "mission",
                    mission,
                    "entity",
                    entityId,
                    HeaderNames.SERVICE,
                    scope.service(),
                    HeaderNames.SERVICE_PATH,
                    scope.servicePath()));
            return file.channel(schema, type + "/" + entityId, "json", metadata);
        }

        /** Returns the schema of a normalized entity, without particular attributes. */
        private static ObjectNode schemaOf(String type) {
            ObjectNode schema = emptySchema(type);
            ObjectNode properties = schema.putObject("properties");
            properties.putObject("id").put("type", "string");
            properties.putObject("type").put("type", "string");
            properties.putObject("deleted").put("type", "boolean");
            ObjectNode attribute = schema.putObject("additionalProperties").put("type", "object");
            ObjectNode members = attribute.putObject("properties");
            members.putObject("type").put("type", "string");
            members.putObject("value");
            members.putObject("metadata").put("type", "object");
            schema.putArray("required").add("id");
            return schema;
        }
    }
}
