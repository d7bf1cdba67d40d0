package io.furrow.control.device;

import java.io.IOException;
import java.net.URI;
import java.net.URLEncoder;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.time.Duration;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Sends commands as updates of the command's attribute at the context broker, which hands them to the IoT Agent. A robot that
 * FIROS speaks for has one attribute for all, {@code cmd}, whose value is the command.
 */
public final class DeviceCommands implements CommandSender {
    private static final Duration PATIENCE = Duration.ofSeconds(5);
    private static final String ROBOT = "Robot";
    private static final int LONGEST_QUOTE = 200;

    private final URI contextBroker;
    private final FiwareScope scope;
    private final HttpClient client =
            HttpClient.newBuilder().connectTimeout(PATIENCE).build();

    /**
     * @param contextBroker for instance {@code http://localhost:1026}
     * @param scope tenant and service path of the devices' entities
     */
    public DeviceCommands(URI contextBroker, FiwareScope scope) {
        this.contextBroker = contextBroker;
        this.scope = scope;
    }

    @Override
    public void send(String deviceId, String type, String command, String value)
            throws IOException, InterruptedException {
        HttpResponse<byte[]> answer = exchange(request(deviceId, type, body(type, command, value)));
        if (answer.statusCode() / 100 != 2) {
            throw new IOException("The context broker at %s refused '%s' for %s with %d: %s"
                    .formatted(contextBroker, command, deviceId, answer.statusCode(), said(answer.body())));
        }
    }

    /** A robot is wanted as {@code Robot}, while its entity is of whatever type it reports, with FIROS {@code ROBOT}. */
    private static boolean isRobot(String type) {
        return ROBOT.equalsIgnoreCase(type);
    }

    private static ObjectNode body(String type, String command, String value) {
        ObjectNode body = JsonNodeFactory.instance.objectNode();
        if (isRobot(type)) {
            body.putObject("cmd").put("type", "String").put("value", command);
        } else {
            body.putObject(command).put("type", "command").put("value", value);
        }
        return body;
    }

    private HttpRequest request(String deviceId, String type, ObjectNode body) {
        String query = isRobot(type) ? "" : "?type=" + encoded(type);
        HttpRequest.Builder request = HttpRequest.newBuilder(URI.create("%s/v2/entities/%s/attrs%s"
                        .formatted(contextBroker.toString().replaceAll("/+$", ""), encoded(deviceId), query)))
                .timeout(PATIENCE)
                .header("Content-Type", "application/json")
                .header("Fiware-Servicepath", scope.servicePath())
                .method("PATCH", HttpRequest.BodyPublishers.ofByteArray(NgsiJson.write(body)));
        if (!scope.service().isEmpty()) {
            request.header("Fiware-Service", scope.service());
        }
        return request.build();
    }

    private HttpResponse<byte[]> exchange(HttpRequest request) throws IOException, InterruptedException {
        try {
            return client.send(request, HttpResponse.BodyHandlers.ofByteArray());
        } catch (IOException e) {
            throw new IOException(
                    "The context broker at %s does not answer (%s). Check that it runs, and whether the device obeyed."
                            .formatted(contextBroker, e),
                    e);
        }
    }

    /** What NGSI errors have as {@code description}. */
    private static String said(byte[] body) {
        String text;
        try {
            text = NgsiJson.read(body).path("description").asText("");
        } catch (UnreadableException e) { // then it is quoted as it is
            text = new String(body, StandardCharsets.UTF_8);
        }
        return text.substring(0, Math.min(text.length(), LONGEST_QUOTE));
    }

    private static String encoded(String part) {
        return URLEncoder.encode(part, StandardCharsets.UTF_8).replace("+", "%20");
    }
}
