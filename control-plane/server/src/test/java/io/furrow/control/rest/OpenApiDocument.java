package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.dataformat.yaml.YAMLMapper;
import com.networknt.schema.JsonSchemaFactory;
import com.networknt.schema.SpecVersion;

import io.furrow.control.rest.description.ApiDescription;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

/** Validates answers against the description of the API: exactly its members, each of its type. */
record OpenApiDocument(ObjectNode json) {
    private static final Set<String> METHODS = Set.of("get", "post", "patch", "put", "delete", "head");

    static OpenApiDocument read() throws IOException {
        try (InputStream in = RestApi.class.getResourceAsStream("openapi.yaml")) {
            return new OpenApiDocument((ObjectNode) new YAMLMapper().readTree(in));
        }
    }

    /** The description as it is served, of version 1. */
    static OpenApiDocument version1() throws IOException {
        return new OpenApiDocument(
                (ObjectNode) new YAMLMapper().readTree(ApiDescription.read().toBytes()));
    }

    /** For instance {@code GET /api/domains}. */
    Set<String> operations() {
        Set<String> operations = new TreeSet<>();
        for (Map.Entry<String, JsonNode> path : json.path("paths").properties()) {
            path.getValue().fieldNames().forEachRemaining(method -> {
                if (METHODS.contains(method)) {
                    operations.add(method.toUpperCase(java.util.Locale.ROOT) + " " + path.getKey());
                }
            });
        }
        return operations;
    }

    /** Fails unless the answer to a request matches its description. Returns its operation. */
    String check(String method, String path, int status, String type, byte[] body) throws Exception {
        String template = json.path("paths").properties().stream()
                .map(Map.Entry::getKey)
                .filter(each -> path.matches(each.replaceAll("\\{[a-z]+}", "[^/]+")))
                .min(java.util.Comparator.comparingInt((String each) -> each.split("\\{", -1).length))
                .orElseThrow(() -> new AssertionError(path + " is not described"));
        JsonNode answer = resolved(json.path("paths")
                .path(template)
                .path(method.toLowerCase(java.util.Locale.ROOT))
                .path("responses")
                .path(Integer.toString(status)));
        assertThat(answer.isMissingNode())
                .as("%s %s with %d is not described", method, template, status)
                .isFalse();
        JsonNode schema = answer.path("content").path(type).path("schema");
        if (type.matches(".*[/+]json") && !method.equals("HEAD")) {
            assertThat(schema.isObject())
                    .as("%s %s with %d as %s is described", method, template, status, type)
                    .isTrue();
            check("%s %s".formatted(method, path), schema, NgsiJson.read(body));
        }
        return method + " " + template;
    }

    /** Fails unless a value has exactly the members of a schema, each of its type. */
    void check(String description, JsonNode schema, JsonNode value) {
        ObjectNode root = schema.deepCopy();
        root.set("components", json.path("components").deepCopy());
        if (resolved(schema).has("allOf")) { // its parts do not know each other's members
            root.put("unevaluatedProperties", false);
        } else {
            close(root);
        }
        assertThat(JsonSchemaFactory.getInstance(SpecVersion.VersionFlag.V202012)
                        .getSchema(root)
                        .validate(value))
                .as("%s: %s", description, value)
                .isEmpty();
    }

    /** The bodies of a request, or of an answer: by media type schema and, if there is one, example. */
    Map<String, JsonNode> bodies(JsonNode described) {
        Map<String, JsonNode> bodies = new TreeMap<>();
        resolved(described).path("content").properties().forEach(media -> bodies.put(media.getKey(), media.getValue()));
        return bodies;
    }

    /** The example of a body, or of its schema. */
    Optional<JsonNode> example(JsonNode body) {
        return body.has("example") ? Optional.of(body.get("example")) : exampleOf(body.path("schema"));
    }

    private Optional<JsonNode> exampleOf(JsonNode schema) {
        JsonNode resolved = resolved(schema);
        if (resolved.path("type").asText().equals("array")) {
            return exampleOf(resolved.path("items")).map(NgsiJson.array()::add);
        }
        return Optional.ofNullable(resolved.path("examples").get(0));
    }

    /** @param operation one of {@link #operations} */
    JsonNode operation(String operation) {
        String[] parts = operation.split(" ");
        return json.path("paths").path(parts[1]).path(parts[0].toLowerCase(java.util.Locale.ROOT));
    }

    JsonNode resolved(JsonNode node) {
        return node.has("$ref") ? json.at(node.path("$ref").asText().substring(1)) : node;
    }

    /** Forbids members that are not described. */
    private static void close(JsonNode schema) {
        if (schema instanceof ObjectNode object
                && object.path("properties").isObject()
                && !object.has("additionalProperties")) {
            object.put("additionalProperties", false);
        }
        schema.forEach(OpenApiDocument::close);
    }
}
