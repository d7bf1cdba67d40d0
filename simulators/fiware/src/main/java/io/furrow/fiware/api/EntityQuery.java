package io.furrow.fiware.api;

import java.time.Instant;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;
import java.util.function.Predicate;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.broker.NgsiTime;
import io.furrow.fiware.broker.Rendering;
import io.furrow.fiware.broker.StoredEntity;
import io.furrow.fiware.broker.SyntaxRules;
import io.furrow.fiware.broker.Tenant;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;
import io.furrow.fiware.http.PathFilter;

/** {@code GET /v2/entities}: filter, order and page. The only {@code q} is a date of the entity, at least a given one. */
record EntityQuery(
        Predicate<StoredEntity> filter, Comparator<StoredEntity> order, Page page, PathFilter paths, Rendering shown) {
    private static final Set<String> PARAMETERS =
            Set.of("id idPattern type typePattern q attrs metadata limit offset orderBy options".split(" "));
    private static final Pattern SINCE = Pattern.compile("(dateCreated|dateModified)>=(.+)");

    private record Page(int offset, int limit) {}

    static EntityQuery of(NgsiRequest call) throws NgsiError {
        for (String name : call.query().getNames()) {
            if (!PARAMETERS.contains(name)) {
                throw NgsiError.unsupported("parameter '" + name + "' in a query of entities");
            }
        }
        Page page = new Page(call.offset(), call.limit());
        return new EntityQuery(filter(call), order(call.list("orderBy")), page, call.paths(), rendering(call));
    }

    NgsiResponse reply(NgsiRequest call, Tenant tenant) {
        List<StoredEntity> found =
                tenant.all(paths).stream().filter(filter).sorted(order).toList();
        ArrayNode entities = JsonNodeFactory.instance.arrayNode();
        found.stream().skip(page.offset()).limit(page.limit()).map(shown::of).forEach(entities::add);
        return NgsiResponse.page(call, entities, found.size());
    }

    static Rendering rendering(NgsiRequest call) {
        return new Rendering(
                call.list("attrs"),
                call.list("metadata"),
                call.option("keyValues") ? Rendering.Format.KEY_VALUES : Rendering.Format.NORMALIZED);
    }

    private static Predicate<StoredEntity> filter(NgsiRequest call) throws NgsiError {
        Predicate<String> id = names(call, "id", "idPattern");
        Predicate<String> type = names(call, "type", "typePattern");
        Predicate<StoredEntity> both = entity -> type.test(entity.type()) && id.test(entity.id());
        return call.parameter("q").isPresent()
                ? both.and(since(call.parameter("q").get()))
                : both;
    }

    private static Predicate<String> names(NgsiRequest call, String exact, String pattern) throws NgsiError {
        List<String> names = call.list(exact);
        Optional<String> regex = call.parameter(pattern);
        if (!names.isEmpty() && regex.isPresent()) {
            throw NgsiError.badRequest("Incompatible parameters: " + exact + ", " + pattern);
        }
        if (regex.isPresent()) {
            return SyntaxRules.pattern(regex.get());
        }
        return names.isEmpty() ? any -> true : Set.copyOf(names)::contains;
    }

    private static Predicate<StoredEntity> since(String q) throws NgsiError {
        Matcher matcher = SINCE.matcher(q);
        Optional<Instant> time = matcher.matches() ? NgsiTime.parse(matcher.group(2)) : Optional.empty();
        if (time.isEmpty()) {
            throw NgsiError.unsupported("q '" + q + "'");
        }
        Function<StoredEntity, Instant> date =
                matcher.group(1).equals("dateCreated") ? StoredEntity::created : StoredEntity::modified;
        return entity -> !date.apply(entity).isBefore(time.get());
    }

    /** The order of creation, or by names; a leading {@code !} reverses it. */
    private static Comparator<StoredEntity> order(List<String> fields) throws NgsiError {
        Comparator<StoredEntity> order = (a, b) -> 0;
        for (String field : fields) {
            boolean descending = field.startsWith("!");
            Comparator<StoredEntity> next = by(descending ? field.substring(1) : field);
            order = order.thenComparing(descending ? next.reversed() : next);
        }
        return order;
    }

    private static Comparator<StoredEntity> by(String field) throws NgsiError {
        return switch (field) {
            case "id" -> Comparator.comparing(StoredEntity::id);
            case "dateCreated" -> Comparator.comparing(StoredEntity::created);
            case "dateModified" -> Comparator.comparing(StoredEntity::modified);
            default -> throw NgsiError.unsupported("orderBy '" + field + "'");
        };
    }
}
