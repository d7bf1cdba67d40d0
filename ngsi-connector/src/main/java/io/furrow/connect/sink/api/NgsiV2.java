package io.furrow.connect.sink.api;

import java.io.ByteArrayOutputStream;
import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.time.Instants;

/**
 * NGSI-v2: {@code POST /v2/op/update} with action {@code append} or {@code delete}. Each attribute carries its event time as metadata, like
 * those of an IoT Agent. An attribute without it was written by another client: it has the entity's {@code Time} or {@code TimeInstant} if
 * it was not changed after that, else its own {@code dateModified}.
 *
 * @param timeMetadata name of the metadata, for instance {@code TimeInstant}
 */
public record NgsiV2(String timeMetadata) implements ContextBrokerApi {
    private static final byte[] START = "{\"actionType\":\"append\",\"entities\":[".getBytes(StandardCharsets.US_ASCII);
    private static final byte[] START_DELETION =
            "{\"actionType\":\"delete\",\"entities\":[".getBytes(StandardCharsets.US_ASCII);
    private static final byte[] END = "]}".getBytes(StandardCharsets.US_ASCII);
    private static final int IDS_PER_READ = 200;
    /** Several entities may share an id; this allows for five on average. */
    private static final int READ_LIMIT = 1000;

    private static final String MODIFIED = "dateModified";

    @Override
    public String name() {
        return "ngsi-v2";
    }

    @Override
    public String idOf(EntityKey key, String type) {
        return key.id();
    }

    @Override
    public byte[] render(AttributeUpdate attributeUpdate) {
        ObjectNode entity = JsonNodeFactory.instance.objectNode();
        entity.put("id", attributeUpdate.key().id()).put("type", attributeUpdate.type());
        attributeUpdate.attributes().forEach((name, attribute) -> {
            long time = attributeUpdate.times().get(name);
            if (time != EntityChange.NO_TIME) {
                ((ObjectNode) attribute.get("metadata"))
                        .putObject(timeMetadata)
                        .put("type", "DateTime")
                        .put("value", Instant.ofEpochMilli(time).toString());
            }
            entity.set(name, attribute);
        });
        return NgsiJson.write(entity);
    }

    @Override
    public BrokerRequest write(FiwareScope scope, List<byte[]> elements) {
        return BrokerRequest.post(scope, "/v2/op/update", joined(START, elements, END));
    }

    static byte[] joined(byte[] start, List<byte[]> elements, byte[] end) {
        int size = start.length + end.length + elements.size();
        for (byte[] element : elements) {
            size += element.length;
        }
        ByteArrayOutputStream body = new ByteArrayOutputStream(size);
        body.writeBytes(start);
        for (int i = 0; i < elements.size(); i++) {
            if (i > 0) {
                body.write(',');
            }
            body.writeBytes(elements.get(i));
        }
        body.writeBytes(end);
        return body.toByteArray();
    }

    @Override
    public Map<String, String> refused(Outcome.Done answer, Collection<String> ids) {
        return Map.of();
    }

    @Override
    public boolean isUnique(EntityKey key) {
        return false;
    }

    @Override
    public BrokerRequest delete(EntityKey key, String type) {
        String query = type.isEmpty() ? "" : "?type=" + encoded(type);
        return BrokerRequest.delete(key.scope(), "/v2/entities/" + encoded(key.id()) + query);
    }

    @Override
    public byte[] renderDeletion(EntityKey key, String type) {
        ObjectNode entity = JsonNodeFactory.instance.objectNode().put("id", key.id());
        return NgsiJson.write(type.isEmpty() ? entity : entity.put("type", type));
    }

    @Override
    public BrokerRequest delete(FiwareScope scope, List<byte[]> elements) {
        return BrokerRequest.post(scope, "/v2/op/update", joined(START_DELETION, elements, END));
    }

    @Override
    public BrokerRequest delete(EntityKey key, EntityTimes.Name attribute) {
        String path = "/v2/entities/%s/attrs/%s?type=%s"
                .formatted(encoded(key.id()), encoded(attribute.attribute()), encoded(attribute.type()));
        return BrokerRequest.delete(key.scope(), path);
    }

    static String encoded(String text) {
        return URLEncoder.encode(text, StandardCharsets.UTF_8).replace("+", "%20");
    }

    @Override
    public int idsPerRead() {
        return IDS_PER_READ;
    }

    /** Without types: finds all entities that share an id, and a deletion may have no type. */
    @Override
    public BrokerRequest read(FiwareScope scope, Map<String, ? extends Collection<String>> ids) {
        ObjectNode body = JsonNodeFactory.instance.objectNode();
        ArrayNode entities = body.putArray("entities");
        ids.keySet().forEach(id -> entities.addObject().put("id", id));
        body.putArray("metadata").add(timeMetadata).add(MODIFIED);
        return BrokerRequest.post(scope, "/v2/op/query?limit=" + READ_LIMIT, NgsiJson.write(body));
    }

    @Override
    public Map<String, EntityTimes> times(Collection<String> asked, Outcome.Done answer) throws UnreadableException {
        Map<String, EntityTimes> times = new HashMap<>();
        for (JsonNode reported : answer.list()) {
            Entity entity = Entity.of(reported);
            addTimes(entity, times.computeIfAbsent(entity.id(), id -> new EntityTimes()));
        }
        return times;
    }

    private void addTimes(Entity entity, EntityTimes times) {
        JsonNode own = entity.json().has("Time")
                ? entity.json().path("Time")
                : entity.json().path("TimeInstant");
        Optional<Long> entityTime = millis(own.path("value"));
        long reportedAt = modified(own);
        entity.attributes().forEach(attribute -> {
            Optional<Long> stated = millis(
                    attribute.getValue().path("metadata").path(timeMetadata).path("value"));
            long modified = modified(attribute.getValue());
            long assumed = entityTime.isPresent() && modified <= reportedAt ? entityTime.get() : modified;
            times.put(entity.type(), attribute.getKey(), stated.orElse(assumed));
        });
    }

    private static long modified(JsonNode attribute) {
        return millis(attribute.path("metadata").path(MODIFIED).path("value")).orElse(EntityChange.NO_TIME);
    }

    private static Optional<Long> millis(JsonNode time) {
        return Instants.of(time).map(Instant::toEpochMilli);
    }
}
