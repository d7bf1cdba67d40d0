package io.furrow.control.provisioning;

import java.io.IOException;
import java.net.URI;
import java.net.URLEncoder;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The provisioning interface of an IoT Agent JSON. Each call is one attempt of at most ten seconds. {@link IOException} means that
 * the agent is away: no answer, 429 or 5xx; {@link RefusedByAgentException} any other refusal.
 */
final class AgentClient {
    private static final Duration PATIENCE = Duration.ofSeconds(10);
    private static final int PAGE = 500;
    private static final String RESOURCE = "/iot/json";
    private static final int CONFLICT = 409;
    private static final int NOT_FOUND = 404;
    private static final int TOO_MANY = 429;
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final HttpClient http = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(PATIENCE)
            .build();
    private final String base;

    /** @param agent as in {@code http://127.0.0.1:4041} */
    AgentClient(URI agent) {
        this.base = agent.toString().replaceAll("/+$", "");
    }

    /**
     * A service group.
     *
     * @param mission static attribute; null where it has none
     */
    record Group(String apiKey, String domain, String mission) {}

    List<Registration> devices(FiwareScope scope) throws IOException, RefusedByAgentException, InterruptedException {
        return pages(scope, "/iot/devices", "devices").stream()
                .map(Registration::read)
                .toList();
    }

    List<Group> groups(FiwareScope scope) throws IOException, RefusedByAgentException, InterruptedException {
        return pages(scope, "/iot/services", "services").stream()
                .map(json -> new Group(json.path("apikey").asText(), null, Registration.mission(json)))
                .toList();
    }

    private List<JsonNode> pages(FiwareScope scope, String path, String list)
            throws IOException, RefusedByAgentException, InterruptedException {
        List<JsonNode> all = new ArrayList<>();
        int before = -1;
        while (all.size() > before && all.size() % PAGE == 0) {
            before = all.size();
            Answer answer = send(scope, "GET", "%s?limit=%d&offset=%d".formatted(path, PAGE, before), null);
            answer.check();
            answer.json().path(list).forEach(all::add);
        }
        return all;
    }

    /** Makes a service group whose devices are those only that are provisioned; one that is there stays. */
    void add(FiwareScope scope, Group group) throws IOException, RefusedByAgentException, InterruptedException {
        ObjectNode json = NODES.objectNode()
                .put("apikey", group.apiKey())
                .put("resource", RESOURCE)
                .put("entity_type", "Thing")
                .put("autoprovision", false);
        Registration.fix(json, group.domain(), group.mission());
        Answer answer = send(scope, "POST", "/iot/services", list("services", List.of(json)));
        if (answer.status() != CONFLICT) {
            answer.check();
        }
    }

    /** Makes all of them or none. */
    void add(FiwareScope scope, List<Registration> devices)
            throws IOException, RefusedByAgentException, InterruptedException {
        List<ObjectNode> bodies = devices.stream().map(Registration::toJson).toList();
        send(scope, "POST", "/iot/devices", list("devices", bodies)).check();
    }

    /** Removes a device; one that is gone already is as good. */
    void removeDevice(FiwareScope scope, String device)
            throws IOException, RefusedByAgentException, InterruptedException {
        removed(send(scope, "DELETE", "/iot/devices/" + encoded(device), null));
    }

    /** Removes a service group; one that is gone already is as good. */
    void removeGroup(FiwareScope scope, String apiKey)
            throws IOException, RefusedByAgentException, InterruptedException {
        removed(send(
                scope,
                "DELETE",
                "/iot/services?resource=%s&apikey=%s".formatted(encoded(RESOURCE), encoded(apiKey)),
                null));
    }

    private static void removed(Answer answer) throws RefusedByAgentException {
        if (answer.status() != NOT_FOUND) {
            answer.check();
        }
    }

    private static ObjectNode list(String name, List<ObjectNode> members) {
        ArrayNode array = NODES.arrayNode().addAll(members);
        return NODES.objectNode().set(name, array);
    }

    private static String encoded(String text) {
        return URLEncoder.encode(text, StandardCharsets.UTF_8).replace("+", "%20");
    }

    private record Answer(String request, int status, byte[] body) {
        void check() throws RefusedByAgentException {
            if (status / 100 != 2) {
                throw new RefusedByAgentException("the IoT Agent answers %d to %s: %s"
                        .formatted(status, request, new String(body, StandardCharsets.UTF_8)));
            }
        }

        JsonNode json() throws IOException {
            try {
                return NgsiJson.read(body);
            } catch (UnreadableException e) {
                throw new IOException("the IoT Agent answers %s with what is no JSON".formatted(request), e);
            }
        }
    }

    private Answer send(FiwareScope scope, String method, String path, JsonNode body)
            throws IOException, InterruptedException {
        HttpRequest.Builder request = HttpRequest.newBuilder(URI.create(base + path))
                .timeout(PATIENCE)
                .header("fiware-servicepath", scope.servicePath());
        if (!scope.service().isEmpty()) {
            request.header("fiware-service", scope.service());
        }
        if (body != null) {
            request.header("Content-Type", "application/json");
        }
        request.method(
                method,
                body == null
                        ? HttpRequest.BodyPublishers.noBody()
                        : HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(body)));
        HttpResponse<byte[]> answer;
        try {
            answer = http.send(request.build(), HttpResponse.BodyHandlers.ofByteArray());
        } catch (IOException e) {
            throw new IOException("the IoT Agent does not answer at %s; is it running?".formatted(base), e);
        }
        int status = answer.statusCode();
        if (status == TOO_MANY || status / 100 == 5) {
            throw new IOException("the IoT Agent at %s answers %d to %s %s".formatted(base, status, method, path));
        }
        return new Answer(method + " " + path, status, answer.body());
    }
}
