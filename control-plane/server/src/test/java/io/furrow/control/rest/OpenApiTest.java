package io.furrow.control.rest;

import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.networknt.schema.JsonSchemaFactory;
import com.networknt.schema.SpecVersion;
import org.glassfish.jersey.server.model.Resource;
import org.glassfish.jersey.server.model.ResourceMethod;
import org.junit.jupiter.api.Test;

import io.furrow.control.rest.access.RoleFilter;
import io.furrow.files.Folders;
import io.furrow.model.control.AdminCommands;
import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.Role;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class OpenApiTest {
    @Test
    void describesEveryRouteAndNoOther() throws Exception {
        Set<String> routes = new TreeSet<>();
        for (Class<?> type : resources()) {
            add(Resource.from(type), "", routes);
        }

        assertThat(OpenApiDocument.read().operations()).isEqualTo(routes);
    }

    @Test
    void hasValidSchemas() throws Exception {
        var meta = JsonSchemaFactory.getInstance(SpecVersion.VersionFlag.V202012)
                .getSchema(java.net.URI.create("https://json-schema.org/draft/2020-12/schema"));
        OpenApiDocument.read()
                .json()
                .at("/components/schemas")
                .forEach(schema -> assertThat(meta.validate(schema)).isEmpty());
    }

    @Test
    void namesEachKindOfAlarmAndAnalyticsJob() throws Exception {
        JsonNode schemas = OpenApiDocument.read().json().at("/components/schemas");

        assertThat(texts(schemas.at("/Alarm/properties/kind/enum")))
                .containsExactlyInAnyOrderElementsOf(
                        Stream.of(AlarmKind.values()).map(AlarmKind::code).toList());
        assertThat(texts(schemas.at("/NewReplay/properties/analytics/items/enum")))
                .containsExactlyInAnyOrderElementsOf(AnalyticsKind.jobNames());
    }

    /** A reader of the description, and the page at /api, see requests and answers as they are. */
    @Test
    void hasAFittingExampleOfEachRequestAndAnswer() throws Exception {
        OpenApiDocument served = OpenApiDocument.version1();
        for (String operation : served.operations()) {
            JsonNode described = served.operation(operation);
            checkExamples(served, operation + ", request", described.path("requestBody"));
            described.path("responses").properties().stream()
                    .filter(answer -> answer.getKey().startsWith("2"))
                    .forEach(answer -> checkExamples(served, operation + ", " + answer.getKey(), answer.getValue()));
            assertThat(described.path("parameters").valueStream().map(served::resolved))
                    .as(operation)
                    .filteredOn(parameter -> parameter.path("in").asText().equals("path"))
                    .hasSize(operation.split("\\{", -1).length - 1)
                    .allMatch(parameter -> parameter.has("example"));
        }
    }

    private static void checkExamples(OpenApiDocument document, String description, JsonNode described) {
        Map<String, JsonNode> bodies = document.bodies(described);
        List<String> withExample = new ArrayList<>();
        bodies.forEach((type, body) -> document.example(body).ifPresent(example -> {
            withExample.add(type);
            document.check(description + " " + type, body.path("schema"), example);
        }));
        bodies.keySet().removeAll(List.of("application/octet-stream", "application/geopackage+sqlite3"));
        assertThat(withExample).as(description).containsAll(bodies.keySet());
    }

    private static List<String> texts(JsonNode values) {
        List<String> texts = new ArrayList<>();
        values.forEach(value -> texts.add(value.asText()));
        return texts;
    }

    @Test
    void hasUniqueOperationIds() throws Exception {
        List<String> ids = OpenApiDocument.read().json().findValuesAsText("operationId");

        assertThat(ids)
                .doesNotHaveDuplicates()
                .hasSameSizeAs(OpenApiDocument.read().operations());
    }

    /** The format duration, which is that of RFC 3339, has no parts of a second. */
    @Test
    void describesPeriodsBelowASecond() throws Exception {
        assertThat(OpenApiDocument.read().json().findValues("period"))
                .filteredOn(JsonNode::isObject) // the others are examples
                .hasSize(2)
                .allMatch(period -> "PT0.5S".matches(period.path("pattern").asText("none")));
    }

    /** Without a manager nothing remembers the key of a request. */
    @Test
    void describesTheIdempotencyKeyWhereItIsKept() throws Exception {
        JsonNode paths = OpenApiDocument.read().json().path("paths");
        for (String path :
                new String[] {"/api/fields", "/api/fields/{field}", "/api/missions/{mission}/markers/{marker}"}) {
            assertThat(paths.path(path).toString()).as(path).doesNotContain("IdempotencyKey");
        }
        assertThat(paths.path("/api/domains").toString()).contains("IdempotencyKey");
    }

    @Test
    void servesVersion1WithTimesInIso8601() throws Exception {
        JsonNode served = OpenApiDocument.version1().json();

        assertThat(served.path("paths").properties())
                .extracting(Map.Entry::getKey)
                .contains("/api/v1/domains", "/health")
                .noneMatch(path -> path.matches("/api/(?!v1/).*"));
        assertThat(served.toString()).doesNotContain("epoch-ms");
        assertThat(served.at("/components/schemas/Domain/properties/created").toString())
                .isEqualTo("{\"type\":\"string\",\"format\":\"date-time\",\"description\":\"When\"}");
    }

    /** A time of an answer that is not marked stays as it is in version 1. */
    @Test
    void marksEachTime() throws Exception {
        OpenApiDocument.read()
                .json()
                .at("/components/schemas")
                .findParents("description")
                .forEach(schema -> {
                    if (schema.path("type").asText().equals("integer")
                            && schema.path("description")
                                    .asText()
                                    .toLowerCase(java.util.Locale.ROOT)
                                    .contains("epoch ms")) {
                        assertThat(schema.path("format").asText())
                                .as("%s", schema)
                                .isEqualTo("epoch-ms");
                    }
                });
    }

    /** Public operations have no role. */
    @Test
    void describesTheRequiredRoles() throws Exception {
        Map<String, String> roles = roles();
        OpenApiDocument document = OpenApiDocument.read();
        for (String operation : document.operations()) {
            JsonNode described = document.operation(operation);
            String role = described.path("security").isArray() ? "" : roles.get(operation);
            assertThat(described.path("x-role").asText()).as(operation).isEqualTo(role);
        }
        assertThat(roles)
                .containsEntry("GET /api/devices/{device}/credentials", "admin")
                .containsEntry("POST /api/devices/{device}/credentials", "admin")
                .containsEntry("DELETE /api/domains/{domain}", "admin")
                .containsEntry("DELETE /api/templates/{template}", "admin")
                .containsEntry("PATCH /api/fields/{field}", "operator")
                .containsEntry("GET /api/devices", "viewer")
                .containsEntry("GET /api/dead-letters", "operator")
                .containsEntry("GET /api/dead-letters/{topic}/{partition}/{offset}", "operator")
                .containsEntry("DELETE /api/missions/{mission}", "operator");
    }

    /** Commands on topics of managers require the same role; the topic of fields has none. */
    @Test
    void namesTheCommandsReservedForAdmins() throws Exception {
        Set<String> operations = new TreeSet<>();
        roles().forEach((operation, role) -> {
            if (role.equals(Role.ADMINS) && !operation.startsWith("GET")) {
                operations.add(operation);
            }
        });

        assertThat(operations)
                .containsExactlyInAnyOrder(
                        "DELETE /api/domains/{domain}",
                        "DELETE /api/fields/{field}",
                        "DELETE /api/recordings/{mission}",
                        "DELETE /api/templates/{template}",
                        "POST /api/devices/{device}/credentials");
        assertThat(AdminCommands.contains(Topics.DOMAIN_MANAGER, "delete")).isTrue();
        assertThat(AdminCommands.contains(Topics.MISSION_MANAGER, "delete-template"))
                .isTrue();
        assertThat(AdminCommands.contains(Topics.MISSION_MANAGER, "rotate-credentials"))
                .isTrue();
        assertThat(AdminCommands.contains(Topics.MISSION_MANAGER, "delete")).isFalse();
    }

    private static Map<String, String> roles() throws Exception {
        Map<String, String> roles = new TreeMap<>();
        for (Class<?> type : resources()) {
            addRoles(Resource.from(type), "", roles);
        }
        return roles;
    }

    private static void addRoles(Resource resource, String before, Map<String, String> roles) {
        String path = path(resource, before);
        for (ResourceMethod method : resource.getResourceMethods()) {
            Role minimum = RoleFilter.minimum(method.getInvocable().getHandlingMethod(), method.getHttpMethod());
            roles.put(method.getHttpMethod() + " " + path, minimum.code());
        }
        resource.getChildResources().forEach(child -> addRoles(child, path, roles));
    }

    private static List<Class<?>> resources() throws Exception {
        var folder = Path.of(RestApi.class.getResource("RestApi.class").toURI()).getParent();
        List<Class<?>> types = new ArrayList<>();
        for (Path file : Folders.list(folder).stream()
                .filter(each -> each.toString().endsWith(".class"))
                .toList()) {
            String name = file.getFileName().toString().replace(".class", "");
            Class<?> type = Class.forName(RestApi.class.getPackageName() + "." + name);
            if (type.isAnnotationPresent(jakarta.ws.rs.Path.class)) {
                types.add(type);
            }
        }
        return types;
    }

    private static void add(Resource resource, String before, Set<String> routes) {
        String path = path(resource, before);
        for (ResourceMethod method : resource.getResourceMethods()) {
            routes.add(method.getHttpMethod() + " " + path);
        }
        resource.getChildResources().forEach(child -> add(child, path, routes));
    }

    private static String path(Resource resource, String before) {
        return (before + "/" + (resource.getPath() == null ? "" : resource.getPath()))
                .replaceAll("/+", "/")
                .replaceAll("\\{([a-z]+):[^}]*}", "{$1}")
                .replaceAll("(?<=.)/$", "");
    }
}
