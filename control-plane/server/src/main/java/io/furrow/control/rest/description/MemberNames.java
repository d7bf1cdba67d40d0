package io.furrow.control.rest.description;

import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * The names that a JSON value may have according to its schema, and whether it is a time. A schema that names no members, or allows additional
 * ones, allows every name.
 *
 * @param document against which references are resolved
 * @param schemas all that apply, in full or as alternatives
 */
public record MemberNames(JsonNode document, List<JsonNode> schemas) {
    private static final List<String> COMPOSITIONS = List.of("allOf", "anyOf", "oneOf");

    static MemberNames of(JsonNode document, JsonNode schema) {
        List<JsonNode> schemas = new ArrayList<>();
        add(document, schema, schemas);
        return new MemberNames(document, schemas);
    }

    private static void add(JsonNode document, JsonNode schema, List<JsonNode> schemas) {
        JsonNode resolved = resolved(document, schema);
        schemas.add(resolved);
        COMPOSITIONS.forEach(each -> resolved.path(each).forEach(part -> add(document, part, schemas)));
    }

    static JsonNode resolved(JsonNode document, JsonNode node) {
        return node.has("$ref") ? document.at(node.path("$ref").asText().substring(1)) : node;
    }

    public Set<String> names() {
        Set<String> names = new TreeSet<>();
        schemas.forEach(schema -> schema.path("properties").fieldNames().forEachRemaining(names::add));
        return names;
    }

    public boolean areFree() {
        boolean isFreeByDefault = names().isEmpty();
        return schemas.stream()
                .anyMatch(schema -> schema.path("additionalProperties").asBoolean(isFreeByDefault));
    }

    /** Whether it is a time in ms since the epoch. */
    boolean isTime() {
        return schemas.stream()
                .anyMatch(schema -> schema.path("format").asText().equals(ApiDescription.EPOCH_MS));
    }

    public MemberNames ofMember(String name) {
        return inner(schema -> schema.path("properties").path(name));
    }

    public MemberNames ofElement() {
        return inner(schema -> schema.path("items"));
    }

    private MemberNames inner(Function<JsonNode, JsonNode> step) {
        List<JsonNode> inner = new ArrayList<>();
        schemas.stream().map(step).filter(JsonNode::isObject).forEach(each -> add(document, each, inner));
        return new MemberNames(document, inner);
    }
}
