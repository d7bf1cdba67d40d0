package io.furrow.control.rest.description;

import java.io.IOException;
import java.io.InputStream;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.dataformat.yaml.YAMLMapper;
import jakarta.ws.rs.container.ContainerRequestContext;
import org.glassfish.jersey.server.ExtendedUriInfo;
import org.glassfish.jersey.uri.UriTemplate;

import io.furrow.model.ngsi.NgsiJson;

/** Reads the description of the API, {@code openapi.yaml}, which has the names that requests may use. */
public final class ApiDescription {
    private final JsonNode json;
    /** By method and declared path. */
    private final Map<List<String>, Optional<Operation>> operations = new ConcurrentHashMap<>();

    private ApiDescription(JsonNode json) {
        this.json = json;
    }

    public static ApiDescription read() throws IOException {
        try (InputStream yaml = ApiDescription.class.getResourceAsStream("/io/furrow/control/rest/openapi.yaml")) {
            return new ApiDescription(new YAMLMapper().readTree(yaml));
        }
    }

    public byte[] toBytes() {
        return NgsiJson.write(json);
    }

    /**
     * The names that an operation has.
     *
     * @param parameters of the query, with their schemas
     * @param headers of a request
     * @param body of a request in JSON
     */
    public record Operation(Map<String, JsonNode> parameters, Set<String> headers, MemberNames body) {}

    /** Returns the operation of a request, as {@link #operation(String, String)}. */
    public Optional<Operation> operation(ContainerRequestContext request) {
        String path = path(request).replaceAll("\\{([a-z]+):[^}]*}", "{$1}");
        return operations.computeIfAbsent(
                List.of(request.getMethod(), path), key -> operation(request.getMethod(), path));
    }

    /** Returns the declared path, so that names do not become labels. */
    public static String path(ContainerRequestContext request) {
        StringBuilder path = new StringBuilder();
        if (request.getUriInfo() instanceof ExtendedUriInfo matched) {
            for (UriTemplate template : matched.getMatchedTemplates()) {
                path.insert(0, template.getTemplate());
            }
        }
        return path.isEmpty() ? "none" : path.toString().replace("//", "/");
    }

    /**
     * Returns an operation; empty if it is public, because probes and scrapers may have parameters of their own.
     *
     * @param path as declared, for instance {@code /api/domains/{domain}}
     */
    public Optional<Operation> operation(String method, String path) {
        JsonNode methods = json.path("paths").path(path);
        JsonNode described = methods.path(method.toLowerCase(Locale.ROOT));
        JsonNode operation = described.isMissingNode() && "HEAD".equals(method) ? methods.path("get") : described;
        if (operation.isMissingNode() || operation.path("security").isArray()) {
            return Optional.empty();
        }
        Map<String, JsonNode> parameters = new TreeMap<>();
        Set<String> headers = new HashSet<>();
        Stream.of(methods, operation)
                .forEach(each -> each.path("parameters").forEach(parameter -> {
                    JsonNode resolved = MemberNames.resolved(json, parameter);
                    if ("query".equals(resolved.path("in").asText())) {
                        parameters.put(resolved.path("name").asText(), resolved.path("schema"));
                    } else if ("header".equals(resolved.path("in").asText())) {
                        headers.add(resolved.path("name").asText());
                    }
                }));
        JsonNode schema = operation.at("/requestBody/content/application~1json/schema");
        return Optional.of(new Operation(parameters, headers, MemberNames.of(json, schema)));
    }
}
