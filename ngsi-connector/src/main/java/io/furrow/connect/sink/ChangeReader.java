package io.furrow.connect.sink;

import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.common.record.TimestampType;
import org.apache.kafka.common.utils.Utils;
import org.apache.kafka.connect.data.Struct;
import org.apache.kafka.connect.sink.SinkRecord;

import io.furrow.connect.record.EntityStruct;
import io.furrow.connect.sink.api.EntityChange;
import io.furrow.connect.sink.api.EntityKey;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads the change and its entity from a record. The value is the output of a converter: bytes or text of JSON, a map
 * of JSON values, or a struct; a tombstone deletes the entity whose id is the record's key, of the type in the
 * header {@code entity-type}, without it of all types.
 *
 * @param defaultScope of records without headers
 * @param defaultType of entities without type, empty for {@code Thing}
 */
record ChangeReader(FiwareScope defaultScope, String defaultType) {
    /** The tenants and paths that a context broker accepts. */
    static final Pattern SERVICE = Pattern.compile("[a-z0-9_]{0,50}");

    static final Pattern SERVICE_PATH = Pattern.compile("/[A-Za-z0-9_/]{0,600}");

    /** @throws UnreadableException if the record does not describe an entity that a context broker can store */
    EntityChange read(SinkRecord record, int source) throws UnreadableException {
        FiwareScope scope = scope(record);
        long time = time(record);
        if (record.value() == null) {
            String type = RecordHeaders.name(record, HeaderNames.ENTITY_TYPE, "");
            return new EntityChange(new EntityKey(scope, key(record)), type, null, time, source);
        }
        JsonNode json = record.value() instanceof Struct struct ? json(struct) : json(record.value());
        if (json instanceof ObjectNode object) {
            complete(object, record);
        }
        Entity entity = Entity.ofAnyForm(json);
        return new EntityChange(new EntityKey(scope, entity.id()), entity.type(), entity, time, source);
    }

    private void complete(ObjectNode entity, SinkRecord record) throws UnreadableException {
        if (!entity.has("id") && record.key() != null) {
            entity.put("id", key(record));
        }
        if (!entity.has("type") && !defaultType.isEmpty()) {
            entity.put("type", defaultType);
        }
    }

    private FiwareScope scope(SinkRecord record) throws UnreadableException {
        FiwareScope scope = FiwareScope.of(
                RecordHeaders.name(record, HeaderNames.SERVICE, defaultScope.service()),
                RecordHeaders.name(record, HeaderNames.SERVICE_PATH, defaultScope.servicePath()));
        if (!SERVICE.matcher(scope.service()).matches()
                || !SERVICE_PATH.matcher(scope.servicePath()).matches()) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "fiware-service or fiware-servicepath is malformed");
        }
        return scope;
    }

    /** The record's timestamp is the event time, unless the topic uses log-append time. */
    private static long time(SinkRecord record) {
        if (record.timestampType() == TimestampType.LOG_APPEND_TIME) {
            return RecordHeaders.millis(record, HeaderNames.CE_TIME).orElse(record.timestamp());
        }
        return record.timestamp() == null || record.timestamp() < 0 ? EntityChange.NO_TIME : record.timestamp();
    }

    private static String key(SinkRecord record) throws UnreadableException {
        Object key = record.key();
        String id = key instanceof byte[] bytes ? new String(bytes, StandardCharsets.UTF_8) : String.valueOf(key);
        if (key == null || id.isBlank() || key instanceof Struct || key instanceof Map) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "the record's key is not an id of an entity");
        }
        return id;
    }

    private static JsonNode json(Struct struct) throws UnreadableException {
        return EntityStruct.isOf(struct.schema()) ? EntityStruct.json(struct) : StructReader.entity(struct);
    }

    private static JsonNode json(Object value) throws UnreadableException {
        if (value instanceof byte[] bytes) {
            return NgsiJson.read(bytes);
        }
        if (value instanceof ByteBuffer buffer) {
            return NgsiJson.read(Utils.toArray(buffer));
        }
        if (value instanceof String text) {
            return NgsiJson.read(text.getBytes(StandardCharsets.UTF_8));
        }
        if (value instanceof Map<?, ?> map) {
            return NgsiJson.mapper().valueToTree(map);
        }
        throw new UnreadableException(
                Reason.NOT_AN_EVENT,
                "a value of " + value.getClass() + " is not an entity; value.converter must give JSON or structs");
    }
}
