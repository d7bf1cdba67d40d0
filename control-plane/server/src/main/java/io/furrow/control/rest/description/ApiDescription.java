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
import java.util.function.UnaryOperator;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.MissingNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.dataformat.yaml.YAMLMapper;
import jakarta.ws.rs.container.ContainerRequestContext;
import org.glassfish.jersey.server.ExtendedUriInfo;
import org.glassfish.jersey.uri.UriTemplate;

import io.furrow.control.rest.access.VersionFilter;
import io.furrow.model.ngsi.NgsiJson;

/** Reads the description of the API, {@code openapi.yaml}, which has the names that requests may use and the times of answers. */
public final class ApiDescription {
    static final String EPOCH_MS = "epoch-ms";

    private static final String PATHS = "paths";
    private static final String PARAMETERS = "parameters";

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

    /** Returns the description of version 1: its paths, with times in ISO 8601. */
    public byte[] toBytes() {
        ObjectNode version = json.deepCopy();
        ObjectNode paths = version.putObject(PATHS);
        json.path(PATHS).properties().forEach(path -> {
            String name = path.getKey().replaceFirst("^/api/", "/" + VersionFilter.VERSION);
            paths.set(name, withParametersOfThePath(path.getValue().deepCopy()));
        });
        describeTimes(version);
        return NgsiJson.write(version);
    }

    /** Gives each operation the parameters of its path: of references there, Swagger UI shows nothing. */
    private static ObjectNode withParametersOfThePath(ObjectNode path) {
        JsonNode shared = path.remove(PARAMETERS);
        if (shared != null) {
            path.forEach(operation -> {
                JsonNode own = operation.path(PARAMETERS);
                ArrayNode all = ((ObjectNode) operation).putArray(PARAMETERS);
                Stream.of(shared, own).forEach(parameters -> parameters.forEach(all::add));
            });
        }
        return path;
    }

    private static void describeTimes(JsonNode node) {
        if (node instanceof ObjectNode schema && schema.path("format").asText().equals(EPOCH_MS)) {
            schema.put("type", "string").put("format", "date-time").remove("minimum");
            String description = schema.path("description").asText().replaceAll("(?i)[,;]? ?epoch ms", "");
            schema.put("description", description.isEmpty() ? "When" : description);
        }
        node.forEach(ApiDescription::describeTimes);
    }

    /**
     * The names that an operation has.
     *
     * @param parameters of the query, with their schemas
     * @param headers of a request
     * @param body of a request in JSON
     * @param answer in JSON, if it succeeds
     */
    public record Operation(
            Map<String, JsonNode> parameters, Set<String> headers, MemberNames body, MemberNames answer) {}

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
        JsonNode methods = json.path(PATHS).path(path);
        JsonNode described = methods.path(method.toLowerCase(Locale.ROOT));
        JsonNode operation = described.isMissingNode() && "HEAD".equals(method) ? methods.path("get") : described;
        if (operation.isMissingNode() || operation.path("security").isArray()) {
            return Optional.empty();
        }
        Map<String, JsonNode> parameters = new TreeMap<>();
        Set<String> headers = new HashSet<>();
        Stream.of(methods, operation)
                .forEach(each -> each.path(PARAMETERS).forEach(parameter -> {
                    JsonNode resolved = MemberNames.resolved(json, parameter);
                    if ("query".equals(resolved.path("in").asText())) {
                        parameters.put(
                                resolved.path("name").asText(), MemberNames.resolved(json, resolved.path("schema")));
                    } else if ("header".equals(resolved.path("in").asText())) {
                        headers.add(resolved.path("name").asText());
                    }
                }));
        JsonNode schema = operation.at("/requestBody/content/application~1json/schema");
        MemberNames answer = Stream.of("200", "201")
                .map(status -> operation.at("/responses/" + status + "/content/application~1json/schema"))
                .filter(JsonNode::isObject)
                .findFirst()
                .map(each -> MemberNames.of(json, each))
                .orElse(MemberNames.of(json, MissingNode.getInstance()));
        return Optional.of(new Operation(parameters, headers, MemberNames.of(json, schema), answer));
    }

    /**
     * Returns what writes the times of a resource as the version of a request has them. It changes what it is given.
     *
     * @param schema of the resource
     */
    public UnaryOperator<ObjectNode> times(ContainerRequestContext request, String schema) {
        if (!VersionFilter.isVersioned(request)) {
            return UnaryOperator.identity();
        }
        MemberNames names = MemberNames.of(json, json.at("/components/schemas/" + schema));
        return resource -> {
            IsoTimes.write(resource, names);
            return resource;
        };
    }
}
