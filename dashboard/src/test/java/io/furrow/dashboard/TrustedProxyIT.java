package io.furrow.dashboard;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.NewTopic;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.dashboard.auth.AddressRange;
import io.furrow.dashboard.auth.TrustedProxy;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.Readiness;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Users whom a proxy signs in, with a real REST API of the control plane. The test acts as the proxy. */
@Tag("full")
class TrustedProxyIT {
    private static final String OLGA = "olga-commands-000001";
    private static final String DASHBOARD = "the-dashboards-own-token";
    private static final String OPERATORS_ONLY = "a-token-of-operators-only";
    private static final String NOT_FOR_USERS = "a-token-for-nobody-else";
    private static final String TOPIC = "data.farm.realtime.weeding";
    private static final String LOOPBACK = "127.0.0.1";
    private static final String USER = "X-Forwarded-User";
    private static final String GROUPS = "X-Forwarded-Groups";
    private static final Duration TIMEOUT = Duration.ofSeconds(30);

    @TempDir
    static Path directory;

    private static EmbeddedKafka kafka;
    private static RestApi api;
    private static RestApi apiWithoutTokens;

    private final HttpClient http = HttpClient.newHttpClient();

    @AutoClose
    private Dashboard dashboard;

    @BeforeAll
    static void startServers() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        Path tokens = directory.resolve("tokens");
        Files.writeString(tokens, """
                olga %s operator
                dashboard %s admin for-users
                dashboard %s operator for-users
                other %s admin
                """.formatted(OLGA, DASHBOARD, OPERATORS_ONLY, NOT_FOR_USERS));
        api = RestApi.start(
                ControlSettings.of(kafka.client()),
                RestSettings.on(0).withTokens(tokens),
                new Readiness(Clock.systemUTC()));
        apiWithoutTokens =
                RestApi.start(ControlSettings.of(kafka.client()), RestSettings.on(0), new Readiness(Clock.systemUTC()));
        kafka.createTopics(List.of(new NewTopic(TOPIC, Optional.of(1), Optional.empty())));

        await().atMost(TIMEOUT).until(() -> api.isReady() && apiWithoutTokens.isReady());
    }

    @AfterAll
    static void stopServers() {
        apiWithoutTokens.close();
        api.close();
        kafka.close();
    }

    private void start(String proxy, String token) throws Exception {
        start(api.uri(), proxy, token);
    }

    private void start(URI controlPlane, String proxy, String token) throws Exception {
        StreamLimits defaults = StreamLimits.DEFAULT;
        dashboard = Dashboard.start(DashboardSettings.of(0, kafka.client(), controlPlane)
                .withLimits(new StreamLimits(
                        10, 10, 3, defaults.ticketLife(), 100, 1_000_000, 10_000, 10_000, 5, defaults.primeRecords()))
                .withProxy(new TrustedProxy(
                        List.of(AddressRange.parse(proxy)),
                        USER,
                        GROUPS,
                        Map.of("farmers", Role.VIEWER, "drivers", Role.OPERATOR, "owners", Role.ADMIN),
                        token)));
    }

    private HttpResponse<String> send(HttpRequest.Builder request, String... headers) throws Exception {
        for (int i = 0; i < headers.length; i += 2) {
            request.header(headers[i], headers[i + 1]);
        }
        return http.send(request.build(), HttpResponse.BodyHandlers.ofString());
    }

    private HttpResponse<String> get(String path, String... headers) throws Exception {
        return send(HttpRequest.newBuilder(dashboard.uri().resolve(path)), headers);
    }

    private static JsonNode json(HttpResponse<String> answer) throws Exception {
        return NgsiJson.read(answer.body().getBytes(UTF_8));
    }

    private static String error(HttpResponse<String> answer) throws Exception {
        return answer.statusCode() + " " + json(answer).path("error").asText();
    }

    private static String me(HttpResponse<String> answer) throws Exception {
        return json(answer).path("user").asText() + " "
                + json(answer).path("role").asText();
    }

    @Test
    void forwardsRequestsInTheNameOfTheUser() throws Exception {
        start(LOOPBACK, DASHBOARD);

        assertThat(me(get("/api/me", USER, "vera@farm", GROUPS, "farmers"))).isEqualTo("vera@farm viewer");
        assertThat(me(get("/api/me", USER, "oskar", GROUPS, "choir, drivers,farmers")))
                .isEqualTo("oskar operator");
        assertThat(me(get("/api/me", USER, "anna", GROUPS, "farmers", GROUPS, "owners")))
                .isEqualTo("anna admin");
        assertThat(me(get("/api/me", USER, "oskar", GROUPS, "drivers", "Authorization", "Bearer of-the-proxy")))
                .isEqualTo("oskar operator");

        HttpResponse<String> posted = send(
                HttpRequest.newBuilder(dashboard.uri().resolve("/api/domains"))
                        .POST(HttpRequest.BodyPublishers.ofString("{\"domain\":\"x\"}"))
                        .header("Content-Type", "application/json"),
                USER,
                "vera",
                GROUPS,
                "farmers");
        assertThat(error(posted)).isEqualTo("403 forbidden");
        assertThat(posted.body()).contains("'vera' is viewer");
    }

    @Test
    void opensSocketsInTheNameOfTheUser() throws Exception {
        start(LOOPBACK, DASHBOARD);

        SocketClient vera = socket(Topics.MISSION_MANAGER, "vera", "farmers");
        SocketClient oskar = socket(Topics.MISSION_MANAGER + "?format=record", "oskar", "drivers");
        vera.send("{\"type\":\"request\"}");
        oskar.send("{\"type\":\"request\",\"command\":\"none\",\"user\":\"vera\"}");

        await().atMost(TIMEOUT)
                .until(() -> vera.frames().stream().anyMatch(frame -> frame.contains("'vera' is viewer")));
        await().atMost(TIMEOUT)
                .until(() -> oskar.records().stream()
                        .anyMatch(record -> record.at("/value/user").asText().equals("oskar")));
    }

    private SocketClient socket(String topic, String user, String group) throws Exception {
        HttpResponse<String> answer = get("/api/register/" + topic, USER, user, GROUPS, group);
        assertThat(answer.statusCode()).as(answer.body()).isEqualTo(200);
        return SocketClient.open(
                http,
                URI.create(dashboard.uri().toString().replace("http", "ws")
                        + json(answer).path("socket").asText()));
    }

    @Test
    void ignoresHeadersOfOtherClients() throws Exception {
        start("192.0.2.0/24", DASHBOARD);

        assertThat(error(get("/api/me", USER, "anna", GROUPS, "owners"))).isEqualTo("401 unauthorized");
        assertThat(error(get("/api/register/" + TOPIC, USER, "anna", GROUPS, "owners")))
                .isEqualTo("401 unauthorized");
        assertThat(error(get("/api/me", "Furrow-User", "anna", "Furrow-Role", "admin")))
                .isEqualTo("401 unauthorized");
        String bearer = "Bearer " + OLGA;
        assertThat(me(get("/api/me", "Authorization", bearer, USER, "anna", GROUPS, "owners")))
                .isEqualTo("olga operator");
        assertThat(me(get("/api/me", "Authorization", bearer, "Furrow-User", "anna", "Furrow-Role", "admin")))
                .isEqualTo("olga operator");
    }

    @Test
    void removesHeadersForTheControlPlaneThatTheProxyForwards() throws Exception {
        start(LOOPBACK, DASHBOARD);

        assertThat(me(get("/api/me", USER, "vera", GROUPS, "farmers", "Furrow-User", "anna", "Furrow-Role", "admin")))
                .isEqualTo("vera viewer");
        assertThat(error(get("/api/me", "Furrow-User", "anna", "Furrow-Role", "admin")))
                .isEqualTo("401 unauthorized");
        assertThat(me(get("/api/me", "Authorization", "Bearer " + OLGA))).isEqualTo("olga operator");
    }

    @Test
    void rejectsUsersWithoutExactlyOneNameOrWithoutARole() throws Exception {
        start(LOOPBACK, DASHBOARD);

        assertThat(error(get("/api/me", USER, "vera"))).isEqualTo("403 no-role");
        assertThat(error(get("/api/me", USER, "vera", GROUPS, "choir"))).isEqualTo("403 no-role");
        assertThat(error(get("/api/me", USER, "vera", USER, "anna", GROUPS, "farmers")))
                .isEqualTo("403 wrong-user");
        assertThat(error(get("/api/me", USER, "vera, anna", GROUPS, "farmers"))).isEqualTo("403 wrong-user");
        assertThat(get("/", USER, "vera").statusCode()).isEqualTo(200);
    }

    @Test
    void limitsUsersToTheRoleOfTheDashboardsToken() throws Exception {
        start(LOOPBACK, OPERATORS_ONLY);

        assertThat(me(get("/api/me", USER, "anna", GROUPS, "owners"))).isEqualTo("anna operator");
    }

    @Test
    void rejectsUsersIfTheControlPlaneDoesNotAcceptThem() throws Exception {
        start(LOOPBACK, NOT_FOR_USERS);
        assertThat(error(get("/api/missions", USER, "vera", GROUPS, "farmers"))).isEqualTo("503 users-not-taken");
        dashboard.close();

        start(apiWithoutTokens.uri(), LOOPBACK, DASHBOARD);
        assertThat(error(get("/api/missions", USER, "vera", GROUPS, "farmers"))).isEqualTo("503 users-not-taken");
    }

    @Test
    void countsTheTicketsOfEachUserSeparately() throws Exception {
        start(LOOPBACK, DASHBOARD);
        for (int i = 0; i < 3; i++) {
            assertThat(get("/api/register/" + TOPIC, USER, "vera", GROUPS, "farmers")
                            .statusCode())
                    .isEqualTo(200);
        }

        assertThat(error(get("/api/register/" + TOPIC, USER, "vera", GROUPS, "farmers")))
                .isEqualTo("429 too-many-tickets");
        assertThat(get("/api/register/" + TOPIC, USER, "oskar", GROUPS, "farmers")
                        .statusCode())
                .isEqualTo(200);
    }
}
