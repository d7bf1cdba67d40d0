package io.furrow.provisioner;

import java.io.IOException;
import java.net.URI;
import java.net.URLEncoder;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Calls the provisioning API of an IoT Agent JSON. Each call is one attempt of at most ten seconds. An {@link
 * IOException} means that the agent is unavailable: no response, a response of a proxy in front of it, an unexpected
 * response, or, as {@link AgentFaultException}, 5xx. A {@link RejectedByAgentException} is any other error. Scopes must
 * name a tenant, because the agent has no default one.
 */
final class AgentClient {
    private static final Duration TIMEOUT = Duration.ofSeconds(10);
    private static final int PAGE = 500;
    private static final int MAX_QUOTE_LENGTH = 300;
    private static final String DEVICES = "/iot/devices";
    private static final String GROUPS = "/iot/services";
    private static final int CONFLICT = 409;
    private static final int NOT_FOUND = 404;
    /** Status codes that a proxy sends. */
    private static final Set<Integer> STATUSES_OF_PROXIES = Set.of(401, 402, 403, 405, 407, 410, 421, 423, 429, 451);

    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final HttpClient http = HttpClient.newBuilder()
            .version(HttpClient.Version.HTTP_1_1)
            .connectTimeout(TIMEOUT)
            .build();
    private final String base;
    private final String resource;
    private final AccessToken token;

    AgentClient(AgentSettings agent) {
        this.base = agent.base().toString().replaceAll("/+$", "");
        this.resource = agent.resource();
        this.token = agent.token();
    }

    /**
     * A service group.
     *
     * @param domain static attribute; null if it has none
     * @param mission static attribute; null if it has none
     */
    record Group(String apiKey, String resource, String domain, String mission) {}

    /** Returns the service group that a device needs. */
    Group groupOf(AgentRegistration device) {
        return new Group(device.apiKey(), resource, device.domain(), device.mission());
    }

    boolean hasOwnResource(Group group) {
        return group.resource().equals(resource);
    }

    List<AgentRegistration> devices(FiwareScope scope)
            throws IOException, RejectedByAgentException, InterruptedException {
        return all(scope, DEVICES, "devices").stream()
                .map(AgentRegistration::read)
                .toList();
    }

    /** Returns the device; empty if the agent has none of this id. */
    Optional<AgentRegistration> device(FiwareScope scope, String id)
            throws IOException, RejectedByAgentException, InterruptedException {
        Answer answer = send(scope, "GET", DEVICES + "/" + encoded(id), null);
        if (answer.isNotFound("DEVICE_NOT_FOUND")) {
            return Optional.empty();
        }
        answer.check();
        return Optional.of(AgentRegistration.read(answer.json()));
    }

    List<Group> groups(FiwareScope scope) throws IOException, RejectedByAgentException, InterruptedException {
        return all(scope, GROUPS, "services").stream()
                .map(json -> new Group(
                        json.path("apikey").asText(),
                        json.path("resource").asText(""),
                        null,
                        AgentRegistration.mission(json)))
                .toList();
    }

    /** Reads page by page until one contains nothing new: the agent returns the whole list of groups for every page. */
    private Set<JsonNode> all(FiwareScope scope, String path, String list)
            throws IOException, RejectedByAgentException, InterruptedException {
        Set<JsonNode> all = new LinkedHashSet<>();
        boolean more = true;
        while (more) {
            Answer answer = send(scope, "GET", path + "?limit=" + PAGE + "&offset=" + all.size(), null);
            if (answer.isNotFound("DEVICE_GROUP_NOT_FOUND")) { // the tenant has no groups
                return all;
            }
            answer.check();
            List<JsonNode> page = answer.members(list);
            more = all.addAll(page) && page.size() >= PAGE;
        }
        return all;
    }

    /**
     * Creates a service group that accepts provisioned devices only.
     *
     * @return false if the agent already has a group of this resource and API key, in any scope
     */
    boolean add(FiwareScope scope, Group group) throws IOException, RejectedByAgentException, InterruptedException {
        ObjectNode json = NODES.objectNode()
                .put("apikey", group.apiKey())
                .put("resource", group.resource())
                .put("entity_type", "Thing")
                .put("autoprovision", false);
        AgentRegistration.fix(json, new AgentRegistration.StaticAttribute(group.domain(), group.mission(), null));
        Answer answer = send(scope, "POST", GROUPS, list("services", List.of(json)));
        if (answer.status() == CONFLICT) {
            return false;
        }
        answer.check();
        return true;
    }

    /**
     * Creates devices. If the agent rejects the request, fails or does not respond, it may have created some and may
     * still be creating others.
     */
    void add(FiwareScope scope, List<AgentRegistration> devices)
            throws IOException, RejectedByAgentException, InterruptedException {
        List<ObjectNode> bodies =
                devices.stream().map(AgentRegistration::toJson).toList();
        send(scope, "POST", DEVICES, list("devices", bodies)).check();
    }

    /** Removes a device, if it exists. */
    void removeDevice(FiwareScope scope, String device)
            throws IOException, RejectedByAgentException, InterruptedException {
        checkRemoved(send(scope, "DELETE", DEVICES + "/" + encoded(device), null), "DEVICE_NOT_FOUND");
    }

    /** Removes a service group, if it exists. */
    void remove(FiwareScope scope, Group group) throws IOException, RejectedByAgentException, InterruptedException {
        checkRemoved(
                send(
                        scope,
                        "DELETE",
                        "%s?resource=%s&apikey=%s"
                                .formatted(GROUPS, encoded(group.resource()), encoded(group.apiKey())),
                        null),
                "DEVICE_GROUP_NOT_FOUND");
    }

    private static void checkRemoved(Answer answer, String absence) throws RejectedByAgentException {
        if (!answer.isNotFound(absence)) {
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
        void check() throws RejectedByAgentException {
            if (status / 100 != 2) {
                throw new RejectedByAgentException(toString());
            }
        }

        /** Whether it is a 404 with this error name. */
        boolean isNotFound(String name) {
            try {
                return status == NOT_FOUND
                        && NgsiJson.read(body).path("name").asText().equals(name);
            } catch (UnreadableException e) { // the response of another server
                return false;
            }
        }

        /** Whether an error has a name, as those of the agent have; a proxy answers with nothing, a page or JSON of its own. */
        boolean isOfAgent() {
            try {
                return NgsiJson.read(body).path("name").isTextual();
            } catch (UnreadableException e) {
                return false;
            }
        }

        List<JsonNode> members(String list) throws IOException {
            if (json().path(list) instanceof ArrayNode array) {
                List<JsonNode> members = new ArrayList<>();
                array.forEach(members::add);
                return members;
            }
            throw new IOException("%s, without a list '%s'; is it an IoT Agent?".formatted(this, list));
        }

        JsonNode json() throws IOException {
            try {
                return NgsiJson.read(body);
            } catch (UnreadableException e) {
                throw new IOException(this + ", which is not JSON; is it an IoT Agent?", e);
            }
        }

        @Override
        public String toString() {
            String text = new String(body, StandardCharsets.UTF_8);
            text = text.substring(0, Math.min(text.length(), MAX_QUOTE_LENGTH));
            return "the IoT Agent answers %d to %s: %s".formatted(status, request, text);
        }
    }

    private Answer send(FiwareScope scope, String method, String path, JsonNode body)
            throws IOException, InterruptedException {
        HttpRequest.Builder request = HttpRequest.newBuilder(URI.create(base + path))
                .timeout(TIMEOUT)
                .header("fiware-service", scope.service())
                .header("fiware-servicepath", scope.servicePath());
        token.addTo(request::header);
        if (body != null) {
            request.header("Content-Type", "application/json");
        }
        request.method(
                method,
                body == null
                        ? HttpRequest.BodyPublishers.noBody()
                        : HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(body)));
        HttpResponse<byte[]> response;
        try {
            response = http.send(request.build(), HttpResponse.BodyHandlers.ofByteArray());
        } catch (IOException e) {
            throw new IOException("the IoT Agent does not answer at %s; is it running?".formatted(base), e);
        }
        Answer answer = new Answer(method + " " + base + path, response.statusCode(), response.body());
        if (answer.status() / 100 == 5) {
            throw new AgentFaultException(answer.toString());
        }
        if (STATUSES_OF_PROXIES.contains(answer.status()) || answer.status() / 100 == 4 && !answer.isOfAgent()) {
            throw new IOException(answer.toString());
        }
        return answer;
    }
}
