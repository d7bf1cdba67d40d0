package io.furrow.control.rest;

import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.kafka.Readiness;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.control.Role;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Calls every described operation with every role. */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class RolesIT {
    private final Map<Role, ApiClient> callers = new EnumMap<>(Role.class);
    private Path tokens;
    private RunningApi running;
    private RestApi api;

    @BeforeAll
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        tokens = directory.resolve("tokens");
        Files.writeString(tokens, """
                vera  token-of-a-viewer-1
                olga  token-of-an-operator  operator
                anna  token-of-an-admin-1   admin
                proxy token-that-speaks-1   operator  for-users
                """);
        api = RestApi.start(
                running.settings(),
                RestSettings.on(0)
                        .withTokens(tokens)
                        .withSecret(SecretSource.of(RunningApi.SECRET))
                        .withTimeout(Duration.ofSeconds(1)),
                new Readiness(Clock.systemUTC()));
        callers.put(Role.VIEWER, new ApiClient(api.uri(), "token-of-a-viewer-1"));
        callers.put(Role.OPERATOR, new ApiClient(api.uri(), "token-of-an-operator"));
        callers.put(Role.ADMIN, new ApiClient(api.uri(), "token-of-an-admin-1"));
        await().until(api::isReady);
    }

    @AfterAll
    void stop() {
        api.close();
        running.close();
    }

    /** @param path with names of missing resources as parameters */
    private record Operation(String method, String path, Role minimum) {}

    static Stream<Operation> operations() throws Exception {
        List<Operation> operations = new ArrayList<>();
        OpenApiDocument document = OpenApiDocument.read();
        for (String each : document.operations()) {
            String method = each.substring(0, each.indexOf(' '));
            String path = each.substring(each.indexOf(' ') + 1);
            JsonNode operation =
                    document.json().path("paths").path(path).path(method.toLowerCase(java.util.Locale.ROOT));
            if (operation.has("x-role")) {
                String named = path.replace("replays/{replay}/{command}", "replays/nosuch.0a1b2c3d/pause")
                        .replace("groups/{group}/{command}", "groups/0a1b2c3d/pause")
                        .replace("{command}", "mute")
                        .replaceAll("\\{[a-z]+}", "nosuch");
                operations.add(new Operation(
                        method,
                        named,
                        Role.of(operation.path("x-role").asText()).orElseThrow()));
            }
        }
        assertThat(operations).hasSizeGreaterThan(25);
        return operations.stream();
    }

    @ParameterizedTest
    @MethodSource("operations")
    void allowsEachRoleOnlyItsOperations(Operation operation) throws Exception {
        for (Role role : Role.values()) {
            ApiClient caller = callers.get(role);
            String body =
                    operation.method().equals("POST") || operation.method().equals("PATCH") ? "{}" : null;
            HttpResponse<byte[]> answer = caller.send(operation.method(), operation.path(), body);
            if (role.includes(operation.minimum())) {
                assertThat(answer.statusCode()).as("%s %s", role, operation).isNotIn(401, 403, 405, 500);
            } else {
                assertThat(caller.error(answer)).as("%s %s", role, operation).isEqualTo("403 forbidden");
                assertThat(caller.json(answer).path("reason").asText())
                        .isEqualTo("this needs the role %s, and '%s' is %s"
                                .formatted(
                                        operation.minimum().code(),
                                        role == Role.VIEWER ? "vera" : "olga",
                                        role.code()));
            }
        }
    }

    @Test
    void servesPublicOperationsWithoutAToken() throws Exception {
        ApiClient anonymous = new ApiClient(api.uri(), null);
        for (String path : List.of("/health", "/metrics", "/openapi.json")) {
            assertThat(anonymous.status("GET", path, null)).as(path).isEqualTo(200);
        }
    }

    /** Public operations are marked, all others have the role of the code. */
    @Test
    void describesTheRoleOfEachOperation() throws Exception {
        OpenApiDocument document = OpenApiDocument.read();
        for (var path : document.json().path("paths").properties()) {
            for (var operation : path.getValue().properties()) {
                if (!operation.getKey().equals("parameters")) {
                    boolean open = operation.getValue().path("security").isArray();
                    assertThat(operation.getValue().has("x-role"))
                            .as("%s %s", operation.getKey(), path.getKey())
                            .isNotEqualTo(open);
                }
            }
        }
    }

    @Test
    void acceptsUserHeadersOnlyWithATokenForUsers() throws Exception {
        assertThat(me("token-that-speaks-1", "vera", "viewer")).contains("200", "\"vera\"", "\"viewer\"");
        assertThat(me("token-that-speaks-1", "anna", "admin")).contains("200", "\"anna\"", "\"operator\"");
        assertThat(me("token-of-an-admin-1", "vera", "viewer")).contains("403", "not-for-users", "'anna'");
        assertThat(me("token-of-a-viewer-1", "anna", "admin")).contains("403", "not-for-users");
        assertThat(me("token-that-speaks-1", "", "admin")).contains("400", "wrong-header");
        assertThat(me("token-that-speaks-1", "an na", "admin")).contains("400", "wrong-header");
        assertThat(me("token-that-speaks-1", "anna", "root")).contains("400", "wrong-header");
        ApiClient delegating = new ApiClient(api.uri(), "token-that-speaks-1");
        assertThat(delegating.error("GET", "/api/me", null, false)).isEqualTo("400 wrong-header");
    }

    private String me(String token, String user, String role) throws Exception {
        HttpResponse<String> answer = HttpClient.newHttpClient()
                .send(
                        HttpRequest.newBuilder(api.uri().resolve("/api/me"))
                                .header("Authorization", "Bearer " + token)
                                .header("Furrow-User", user)
                                .header("Furrow-Role", role)
                                .build(),
                        HttpResponse.BodyHandlers.ofString());
        return answer.statusCode() + answer.body();
    }

    @Test
    void reloadsTokensAndRetainsTheOldOnesIfTheFileIsInvalid() throws Exception {
        ApiClient late = new ApiClient(api.uri(), "token-of-a-late-one");
        String before = Files.readString(tokens);
        assertThat(late.status("GET", "/api/domains", null)).isEqualTo(401);
        try {
            Files.writeString(tokens, before + "lea token-of-a-late-one viewer\n");
            await().until(() -> late.status("GET", "/api/domains", null) == 200);
            assertThat(late.get("/health").path("warnings")).isEmpty();

            Files.writeString(tokens, "lea short viewer\n");
            await().until(() -> late.get("/health")
                    .at("/warnings/0")
                    .asText()
                    .equals("the file of tokens cannot be used as it is; the previous tokens stay valid"));
            assertThat(late.status("GET", "/api/domains", null)).isEqualTo(200);

            Files.writeString(tokens, before);
            await().until(() -> late.status("GET", "/api/domains", null) == 401);
            assertThat(late.get("/health").path("warnings")).isEmpty();
        } finally {
            Files.writeString(tokens, before);
        }
    }
}
