package io.furrow.connect.sink.api;

import java.time.Instant;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.LogText;
import io.furrow.model.time.Instants;

/**
 * NGSI-LD: {@code POST /ngsi-ld/v1/entityOperations/upsert?options=update}, and {@code …/delete}. Each attribute carries its event time as
 * {@code observedAt}, by default its {@code modifiedAt}.
 *
 * @param context URL of the {@code @context} that names the types and attributes; empty for the core context alone
 */
public record NgsiLd(String context) implements ContextBrokerApi {
    private static final byte[] START = {'['};
    private static final byte[] END = {']'};
    /** The ids are part of the URL. */
    private static final int IDS_PER_READ = 40;

    private static final int MULTI_STATUS = 207;

    private static final Set<String> NO_ATTRIBUTES =
            Set.of("id", "type", "@context", "scope", "createdAt", "modifiedAt", "deletedAt", "expiresAt");
    private static final String LINK_FORM =
            "<%s>; rel=\"http://www.w3.org/ns/json-ld#context\"; type=\"application/ld+json\"";

    @Override
    public String name() {
        return "ngsi-ld";
    }

    @Override
    public String idOf(EntityKey key, String type) {
        return type.isEmpty() ? key.id() : NgsiLdCodec.id(key.id(), type);
    }

    @Override
    public boolean isUnique(EntityKey key) {
        return NgsiLdCodec.isUri(key.id());
    }

    @Override
    public byte[] render(AttributeUpdate attributeUpdate) {
        return NgsiJson.write(NgsiLdCodec.of(attributeUpdate));
    }

    @Override
    public List<String> cleared(AttributeUpdate attributeUpdate) {
        return attributeUpdate.attributes().entrySet().stream()
                .filter(each -> NgsiLdCodec.isNull(each.getValue()))
                .map(Map.Entry::getKey)
                .toList();
    }

    @Override
    public BrokerRequest write(FiwareScope scope, List<byte[]> elements) {
        byte[] body = NgsiV2.joined(START, elements, END);
        return scoped(BrokerRequest.post(scope, "/ngsi-ld/v1/entityOperations/upsert?options=update", body));
    }

    /**
     * An answer 207 names each entity that was not written, and the reason; some context brokers also name the written
     * ones.
     */
    @Override
    public Map<String, String> refused(Outcome.Done answer, Collection<String> ids) throws UnreadableException {
        if (answer.status() != MULTI_STATUS) {
            return Map.of();
        }
        JsonNode body = answer.json();
        Map<String, String> refused = new HashMap<>();
        for (JsonNode error : body.path("errors")) {
            JsonNode id = error.path("entityId");
            String words = error.has("error") ? error.get("error").toString() : error.toString();
            refused.put(id.isArray() ? id.path(0).asText() : id.asText(), LogText.beginning(words));
        }
        Set<String> answered = new HashSet<>(refused.keySet());
        body.path("success").forEach(success -> answered.add(success.asText()));
        boolean areAllErrorsOurs = !refused.isEmpty() && ids.containsAll(refused.keySet());
        if (!areAllErrorsOurs && !answered.containsAll(ids)) {
            throw new UnreadableException(Reason.NOT_AN_ENTITY, "it does not say which entities were refused");
        }
        return refused;
    }

    @Override
    public BrokerRequest delete(EntityKey key, String type) {
        return scoped(BrokerRequest.delete(key.scope(), "/ngsi-ld/v1/entities/" + NgsiV2.encoded(idOf(key, type))));
    }

    @Override
    public byte[] renderDeletion(EntityKey key, String type) {
        return NgsiJson.write(JsonNodeFactory.instance.textNode(idOf(key, type)));
    }

    @Override
    public BrokerRequest delete(FiwareScope scope, List<byte[]> elements) {
        byte[] body = NgsiV2.joined(START, elements, END);
        return scoped(BrokerRequest.post(scope, "/ngsi-ld/v1/entityOperations/delete", body));
    }

    @Override
    public BrokerRequest delete(EntityKey key, EntityTimes.Name attribute) {
        String id = NgsiLdCodec.id(key.id(), attribute.type());
        String path =
                "/ngsi-ld/v1/entities/%s/attrs/%s".formatted(NgsiV2.encoded(id), NgsiV2.encoded(attribute.attribute()));
        return scoped(BrokerRequest.delete(key.scope(), path));
    }

    @Override
    public int idsPerRead() {
        return IDS_PER_READ;
    }

    /**
     * With the types, because a query needs a type, an attribute or a query expression; with the lowest sufficient limit, because brokers
     * reject too high ones.
     */
    @Override
    public BrokerRequest read(FiwareScope scope, Map<String, ? extends Collection<String>> ids) {
        Set<String> names = new HashSet<>();
        Set<String> types = new HashSet<>();
        ids.forEach((id, of) -> {
            of.forEach(type -> names.add(type.isEmpty() ? id : NgsiLdCodec.id(id, type)));
            types.addAll(of);
        });
        String desired = "&options=sysAttrs&limit=" + names.size() + "&id=" + list(names);
        String query = types.contains("") ? "local=true" : "type=" + list(types);
        return scoped(BrokerRequest.get(scope, "/ngsi-ld/v1/entities?" + query + desired));
    }

    private static String list(Set<String> names) {
        return names.stream().sorted().map(NgsiV2::encoded).collect(Collectors.joining(","));
    }

    @Override
    public Map<String, EntityTimes> times(Collection<String> asked, Outcome.Done answer) throws UnreadableException {
        Map<String, EntityTimes> found = new HashMap<>();
        for (JsonNode entity : answer.list()) {
            String type = entity.path("type").asText();
            String id = entity.path("id").asText();
            for (String key : asked) {
                if (id.equals(NgsiLdCodec.id(key, type)) || id.equals(key)) {
                    addTimes(entity, type, found.computeIfAbsent(key, any -> new EntityTimes()));
                }
            }
        }
        return found;
    }

    private static void addTimes(JsonNode entity, String type, EntityTimes times) {
        for (Map.Entry<String, JsonNode> attribute : entity.properties()) {
            if (!NO_ATTRIBUTES.contains(attribute.getKey())) {
                JsonNode value = attribute.getValue();
                long newest = EntityChange.NO_TIME;
                for (JsonNode instance : value.isArray()
                        ? value
                        : JsonNodeFactory.instance.arrayNode().add(value)) {
                    newest = Math.max(newest, time(instance));
                }
                times.put(type, attribute.getKey(), newest);
            }
        }
    }

    private static long time(JsonNode instance) {
        return Instants.of(instance.path("observedAt"))
                .or(() -> Instants.of(instance.path("modifiedAt")))
                .map(Instant::toEpochMilli)
                .orElse(EntityChange.NO_TIME);
    }

    private BrokerRequest scoped(BrokerRequest request) {
        String service = request.scope().service();
        BrokerRequest named = service.isEmpty() ? request : request.withHeader("NGSILD-Tenant", service);
        return context.isEmpty() ? named : named.withHeader("Link", LINK_FORM.formatted(context));
    }
}
