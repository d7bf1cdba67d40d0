package io.furrow.control.device;

import java.io.IOException;
import java.net.URI;
import java.net.URLEncoder;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CompletionException;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.Semaphore;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/**
 * Sends commands as updates of the command's attribute at the context broker, which forwards them to the IoT Agent. A
 * robot connected by FIROS has a single attribute {@code cmd} for all commands, whose value is the command. The
 * attribute is appended if missing, because an update would be rejected. Its type, of which the desired one may differ,
 * is named only if the id is ambiguous without it.
 */
public final class DeviceCommands implements CommandSender {
    private static final Duration TIMEOUT = Duration.ofSeconds(5);
    /** Maximum number of asynchronous commands in flight. */
    private static final int MAX_PENDING = 64;

    private static final int MAX_QUOTE_LENGTH = 200;
    private static final String ERROR = "error";
    private static final int NOT_FOUND = 404;
    /** Of the context broker; a proxy that cannot find it answers 404 as well. An error of a proxy may have a path. */
    private static final Set<String> ABSENCES = Set.of("NotFound", "NonExistingTenant");

    private static final int CONFLICT = 409;
    private static final String AMBIGUOUS = "TooManyResults";
    /** Permanent rejections. Other 4xx responses concern the control plane, like those of a proxy. */
    private static final Set<Integer> REJECTIONS = Set.of(400, NOT_FOUND, CONFLICT, 422);

    private final Semaphore pending;
    private final URI contextBroker;
    private final FiwareScope scope;
    private final AccessToken token;
    private final HttpClient client;

    /**
     * @param contextBroker for instance {@code http://localhost:1026}
     * @param scope tenant and service path of the devices' entities
     * @param token of each request
     */
    public DeviceCommands(URI contextBroker, FiwareScope scope, AccessToken token) {
        this(
                contextBroker,
                scope,
                token,
                HttpClient.newBuilder().connectTimeout(TIMEOUT).build(),
                new Semaphore(MAX_PENDING));
    }

    private DeviceCommands(
            URI contextBroker, FiwareScope scope, AccessToken token, HttpClient client, Semaphore pending) {
        this.contextBroker = contextBroker;
        this.scope = scope;
        this.token = token;
        this.client = client;
        this.pending = pending;
    }

    @Override
    public DeviceCommands in(FiwareScope other) {
        return new DeviceCommands(contextBroker, other, token, client, pending);
    }

    /**
     * A command to a device, with the arguments of {@link CommandSender#send}.
     *
     * @param type as the device last reported it, if it did
     * @param value any JSON value, an empty text for none; a robot accepts none
     */
    public record Order(String deviceId, String type, String command, JsonNode value) {}

    @Override
    public void send(String deviceId, String type, String command, String value)
            throws IOException, InterruptedException {
        HttpResponse<byte[]> answer;
        Order order = new Order(deviceId, type, command, TextNode.valueOf(value));
        try {
            answer = client.send(request(order, false), HttpResponse.BodyHandlers.ofByteArray());
            if (isAmbiguous(order, answer)) {
                answer = client.send(request(order, true), HttpResponse.BodyHandlers.ofByteArray());
            }
        } catch (IOException e) {
            throw unavailable(e);
        }
        check(order, answer);
    }

    /**
     * Sends a command asynchronously.
     *
     * @return completes once the context broker has accepted the command, exceptionally with the {@link IOException} of
     * {@link CommandSender#send}, or at once with {@link RejectedExecutionException} if too many commands are in flight
     */
    public CompletableFuture<Void> send(Order order) {
        if (!pending.tryAcquire()) {
            return CompletableFuture.failedFuture(new RejectedExecutionException(
                    "%d commands wait for the context broker at %s already; try again later"
                            .formatted(MAX_PENDING, contextBroker)));
        }
        return client.sendAsync(request(order, false), HttpResponse.BodyHandlers.ofByteArray())
                .thenCompose(answer -> isAmbiguous(order, answer)
                        ? client.sendAsync(request(order, true), HttpResponse.BodyHandlers.ofByteArray())
                        : CompletableFuture.completedFuture(answer))
                .whenComplete((answer, failure) -> pending.release())
                .handle((answer, failure) -> {
                    try {
                        if (failure != null) {
                            throw unavailable(FailureText.unwrap(failure));
                        }
                        check(order, answer);
                        return null;
                    } catch (IOException e) {
                        throw new CompletionException(e);
                    }
                });
    }

    private IOException unavailable(Throwable failure) {
        return new IOException(
                "The context broker at %s does not respond (%s). Check that it runs, and whether the device obeyed."
                        .formatted(contextBroker, FailureText.of(failure)),
                failure);
    }

    private void check(Order order, HttpResponse<byte[]> answer) throws IOException {
        if (answer.statusCode() / 100 == 2 && answer.body().length == 0) {
            return;
        }
        int status = answer.statusCode();
        JsonNode error = error(answer.body());
        boolean isOfBroker = status == NOT_FOUND
                ? ABSENCES.contains(error.path(ERROR).asText())
                : error.path(ERROR).isTextual() && !error.has("path") && REJECTIONS.contains(status);
        if (isOfBroker && status == NOT_FOUND) {
            throw new RejectedCommandException(
                    NOT_FOUND,
                    "The context broker at %s has no entity %s of type %s, so '%s' cannot be sent; a device accepts commands once it has reported. Check that it reports."
                            .formatted(contextBroker, order.deviceId(), order.type(), order.command()));
        }
        String rejected = "The context broker at %s rejected '%s' for %s with %d: %s"
                .formatted(
                        contextBroker,
                        order.command(),
                        order.deviceId(),
                        status,
                        quoted(error.path("description").asText(new String(answer.body(), StandardCharsets.UTF_8))));
        throw isOfBroker ? new RejectedCommandException(status, rejected) : new IOException(rejected);
    }

    /** Whether entities of several types have the id, and the request named none of them. */
    private static boolean isAmbiguous(Order order, HttpResponse<byte[]> answer) {
        return isRobot(order.type())
                && answer.statusCode() == CONFLICT
                && AMBIGUOUS.equals(error(answer.body()).path(ERROR).textValue());
    }

    /** The desired type of a robot is {@code Robot}, while its entity has the type that it reports, {@code ROBOT} with FIROS. */
    public static boolean isRobot(String type) {
        return DesiredDevice.ROBOT.equalsIgnoreCase(type);
    }

    private static ObjectNode body(String type, String command, JsonNode value) {
        ObjectNode body = NgsiJson.object();
        if (isRobot(type)) {
            body.putObject("cmd").put("type", "String").put("value", command);
            // Resets the result of an earlier command.
            body.putObject("cmd_status").put("type", "commandStatus").put("value", "PENDING");
        } else {
            body.putObject(command).put("type", "command").set("value", value);
        }
        return body;
    }

    /** @param typed whether to name the type of a robot */
    private HttpRequest request(Order order, boolean typed) {
        String deviceId = order.deviceId();
        String type = order.type();
        ObjectNode body = body(type, order.command(), order.value());
        String typeQuery = "type=" + encoded(type);
        // Notifies a robot also if the command is the same as before.
        String query = isRobot(type) ? "?options=forcedUpdate" + (typed ? "&" + typeQuery : "") : "?" + typeQuery;
        HttpRequest.Builder request = HttpRequest.newBuilder(URI.create("%s/v2/entities/%s/attrs%s"
                        .formatted(contextBroker.toString().replaceAll("/+$", ""), encoded(deviceId), query)))
                .timeout(TIMEOUT)
                .header("Content-Type", "application/json")
                .header("Fiware-Servicepath", scope.servicePath())
                .method(isRobot(type) ? "POST" : "PATCH", HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(body)));
        if (!scope.service().isEmpty()) {
            request.header("Fiware-Service", scope.service());
        }
        token.addTo(request::header);
        return request.build();
    }

    /** Returns an error of the context broker; a missing node for another body, such as the page or JSON of a proxy. */
    private static JsonNode error(byte[] body) {
        try {
            JsonNode json = NgsiJson.read(body);
            return json.path(ERROR).isTextual() ? json : MissingNode.getInstance();
        } catch (UnreadableException e) {
            return MissingNode.getInstance();
        }
    }

    private static String quoted(String text) {
        return text.isEmpty() ? "it does not say why" : text.substring(0, Math.min(text.length(), MAX_QUOTE_LENGTH));
    }

    private static String encoded(String part) {
        return URLEncoder.encode(part, StandardCharsets.UTF_8).replace("+", "%20");
    }
}
