package io.furrow.fiware.api;

import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.Call;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.PathFilter;
import io.furrow.fiware.broker.QueryFilter;
import io.furrow.fiware.broker.Rendering;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.fiware.broker.Tenant;

/**
 * {@code POST /v2/op/query}: entities by id or id pattern, each with an optional type, and {@code expression.q};
 * attributes and metadata as in a query by GET.
 */
final class BatchQuery {
    private BatchQuery() {}

    static Reply reply(Call call, ContextBroker broker) throws NgsiError {
        JsonNode body = call.json();
        JsonNode q = body.path("expression").path("q");
        Predicate<StoredEntity> filter = q.isTextual() ? QueryFilter.parse(q.textValue()) : any -> true;
        Tenant tenant = broker.tenant(call.service());
        Set<StoredEntity> found = new LinkedHashSet<>();
        for (JsonNode asked : body.path("entities")) {
            found.addAll(find(tenant, call.paths(), asked));
        }
        if (!body.has("entities")) {
            found.addAll(tenant.all(call.paths()));
        }
        Rendering shown = new Rendering(
                texts(body.path("attrs")), Set.of(), texts(body.path("metadata")), Rendering.Format.NORMALIZED);
        ArrayNode entities = JsonNodeFactory.instance.arrayNode();
        found.stream()
                .filter(filter)
                .skip(EntityQuery.number(call, "offset", 0))
                .limit(EntityQuery.limit(call))
                .map(shown::of)
                .forEach(entities::add);
        return Reply.ok(entities);
    }

    private static List<StoredEntity> find(Tenant tenant, PathFilter paths, JsonNode asked) throws NgsiError {
        Optional<String> type = Optional.ofNullable(asked.path("type").textValue());
        if (asked.path("id").isTextual()) {
            SyntaxRules.checkEntity(asked.get("id").textValue(), type);
            return tenant.find(paths, asked.get("id").textValue(), type);
        }
        if (!asked.path("idPattern").isTextual()) {
            throw NgsiError.badRequest("nor id nor idPattern are present");
        }
        Predicate<String> pattern = QueryFilter.pattern(asked.get("idPattern").textValue());
        return tenant.all(paths).stream()
                .filter(entity -> pattern.test(entity.id())
                        && (type.isEmpty() || type.get().equals(entity.type())))
                .toList();
    }

    private static List<String> texts(JsonNode list) {
        List<String> texts = new ArrayList<>();
        list.forEach(text -> texts.add(text.asText()));
        return texts;
    }
}
