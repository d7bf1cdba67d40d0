package io.furrow.fiware.api;

import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.Call;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.broker.Attribute;
import io.furrow.fiware.broker.PathFilter;
import io.furrow.fiware.broker.QueryFilter;
import io.furrow.fiware.broker.Rendering;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.fiware.broker.Tenant;

/** {@code GET /v2/entities}: filter, order and page. */
public record EntityQuery(
        Predicate<StoredEntity> filter, Comparator<StoredEntity> order, Page page, PathFilter paths, Rendering shown) {
    private static final int DEFAULT_LIMIT = 20;
    private static final int MAX_LIMIT = 1000;
    private static final Set<String> PARAMETERS = Set.of(
            "id",
            "idPattern",
            "type",
            "typePattern",
            "q",
            "attrs",
            "metadata",
            "limit",
            "offset",
            "orderBy",
            "options");

    private record Page(int offset, int limit) {}

    static EntityQuery of(Call call) throws NgsiError {
        for (String name : call.query().getNames()) {
            if (!PARAMETERS.contains(name)) {
                throw NgsiError.unsupported("parameter '" + name + "' in a query of entities");
            }
        }
        Page page = new Page(number(call, "offset", 0), limit(call));
        return new EntityQuery(filter(call), order(call.list("orderBy")), page, call.paths(), rendering(call));
    }

    Reply reply(Call call, Tenant tenant) {
        List<StoredEntity> found =
                tenant.all(paths).stream().filter(filter).sorted(order).toList();
        ArrayNode entities = JsonNodeFactory.instance.arrayNode();
        found.stream().skip(page.offset()).limit(page.limit()).map(shown::of).forEach(entities::add);
        return Reply.page(call, entities, found.size());
    }

    static Rendering rendering(Call call) {
        Rendering.Format format = Rendering.Format.NORMALIZED;
        for (Rendering.Format candidate : Rendering.Format.values()) {
            if (!candidate.isBare() && call.option(candidate.label())) {
                format = candidate;
            }
        }
        return new Rendering(call.list("attrs"), Set.of(), call.list("metadata"), format);
    }

    private static Predicate<StoredEntity> filter(Call call) throws NgsiError {
        Predicate<String> id = names(call, "id", "idPattern");
        Predicate<String> type = names(call, "type", "typePattern");
        Predicate<StoredEntity> both = entity -> type.test(entity.type()) && id.test(entity.id());
        return call.parameter("q").isPresent()
                ? both.and(QueryFilter.parse(call.parameter("q").get()))
                : both;
    }

    private static Predicate<String> names(Call call, String exact, String pattern) throws NgsiError {
        List<String> names = call.list(exact);
        Optional<String> regex = call.parameter(pattern);
        if (!names.isEmpty() && regex.isPresent()) {
            throw NgsiError.badRequest("Incompatible parameters: " + exact + ", " + pattern);
        }
        if (regex.isPresent()) {
            return QueryFilter.pattern(regex.get());
        }
        return names.isEmpty() ? any -> true : Set.copyOf(names)::contains;
    }

    /** The order of creation, or by attributes; a leading {@code !} reverses it. */
    private static Comparator<StoredEntity> order(List<String> fields) {
        Comparator<StoredEntity> order = (a, b) -> 0;
        for (String field : fields) {
            boolean descending = field.startsWith("!");
            Comparator<StoredEntity> next = by(descending ? field.substring(1) : field);
            order = order.thenComparing(descending ? next.reversed() : next);
        }
        return order;
    }

    private static Comparator<StoredEntity> by(String field) {
        return switch (field) {
            case "id" -> Comparator.comparing(StoredEntity::id);
            case "type" -> Comparator.comparing(StoredEntity::type);
            case "dateCreated" -> Comparator.comparing(StoredEntity::created);
            case "dateModified" -> Comparator.comparing(StoredEntity::modified);
            default ->
                (a, b) -> compare(a.attributes().get(field), b.attributes().get(field));
        };
    }

    private static int compare(Attribute a, Attribute b) {
        if (a == null || b == null) {
            return Boolean.compare(a != null, b != null);
        }
        return a.value().isNumber() && b.value().isNumber()
                ? a.value().decimalValue().compareTo(b.value().decimalValue())
                : a.value().asText().compareTo(b.value().asText());
    }

    public static int limit(Call call) throws NgsiError {
        int limit = number(call, "limit", DEFAULT_LIMIT);
        if (limit > MAX_LIMIT) {
            throw NgsiError.badRequest("Bad pagination limit: /" + limit + "/ [max: " + MAX_LIMIT + "]");
        }
        return limit;
    }

    public static int number(Call call, String name, int otherwise) throws NgsiError {
        String text = call.parameter(name).orElse(Integer.toString(otherwise));
        if (!text.matches("\\d{1,9}")) {
            throw NgsiError.badRequest("Bad pagination " + name + ": /" + text + "/ [must be a decimal number]");
        }
        return Integer.parseInt(text);
    }
}
