package io.furrow.control.device;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.nayuki.qrcodegen.QrCode;

import io.furrow.model.control.MeasuredAttribute;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.ngsi.NgsiJson;

/**
 * Describes how to set up a device: address of the MQTT broker, login, topics, attributes, and a command that sends one
 * measure.
 *
 * @param secret of the farm
 * @param broker address for devices, {@code mqtt://host:port} or {@code mqtts://host:port}; null if unknown
 */
public record DeviceCredentials(Supplier<FarmSecret> secret, URI broker) {
    private static final List<String> QR =
            List.of("host", "port", "tls", "user", "password", "measures", "commands", "results");
    /** Width of the border, in modules. */
    private static final int QUIET = 4;

    private static final int TLS_PORT = 8883;
    private static final int PORT = 1883;

    /** Whether the farm issues a login for a device: devices listed by id only have their own, simulated robots need none. */
    public static boolean areIssuedFor(DesiredDevice device) {
        return device.device() != null && !(device.simulated() && device.isRobot());
    }

    /** Returns address, login and topics as JSON in a QR code, as SVG. */
    public String qr(DesiredDevice device) {
        ObjectNode json = of(device).retain(QR);
        QrCode code = QrCode.encodeText(new String(NgsiJson.write(json), StandardCharsets.UTF_8), QrCode.Ecc.LOW);
        StringBuilder path = new StringBuilder();
        for (int y = 0; y < code.size; y++) {
            for (int x = 0; x < code.size; x++) {
                if (code.getModule(x, y)) {
                    path.append("M" + (x + QUIET) + " " + (y + QUIET) + "h1v1h-1z");
                }
            }
        }
        return """
                <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %1$d %1$d" shape-rendering="crispEdges">\
                <rect width="100%%" height="100%%" fill="#fff"/><path d="%2$s"/></svg>
                """.formatted(code.size + 2 * QUIET, path);
    }

    /** @param device including the settings of its group */
    public ObjectNode of(DesiredDevice device) {
        String mission = device.version().mission();
        FarmSecret now = secret.get();
        FarmSecret.Login login = now.device(mission, device.device(), device.generation());
        String topic = "/%s/%s/".formatted(now.apiKey(mission), device.device());
        List<MeasuredAttribute> attributes = device.attributes();
        ObjectNode json = NgsiJson.object()
                .put("device", device.version().id())
                .put("deviceId", device.device())
                .put("mission", mission);
        if (broker != null) {
            json.put("host", broker.getHost()).put("port", port()).put("tls", isTls());
        }
        json.put("user", login.user())
                .put("password", login.password())
                .put("apiKey", now.apiKey(mission))
                .put("measures", topic + "attrs")
                .put("commands", topic + "cmd")
                .put("results", topic + "cmdexe")
                .put("key", now.newestKey())
                .put("generation", device.generation());
        ArrayNode sent = json.putArray("attributes");
        attributes.forEach(each -> {
            ObjectNode attribute = each.toJson();
            if (each.unit() != null) {
                attribute.put("unit", each.unit());
            }
            sent.add(attribute);
        });
        return json.put("example", example(topic + "attrs", login, attributes));
    }

    private boolean isTls() {
        return Stream.of("mqtts", "ssl").anyMatch(broker.getScheme()::equals);
    }

    private int port() {
        int defaultPort = isTls() ? TLS_PORT : PORT;
        return broker.getPort() < 0 ? defaultPort : broker.getPort();
    }

    private String example(String topic, FarmSecret.Login login, List<MeasuredAttribute> attributes) {
        List<String> arguments = new ArrayList<>(List.of("mosquitto_pub"));
        if (broker != null) {
            arguments.addAll(List.of("-h", broker.getHost(), "-p", Integer.toString(port())));
            if (isTls()) {
                arguments.add("--tls-use-os-certs");
            }
        }
        arguments.addAll(List.of("-u", quoted(login.user()), "-P", quoted(login.password()), "-q", "1"));
        arguments.addAll(List.of("-t", quoted(topic), "-m", quoted(measure(attributes))));
        return String.join(" ", arguments);
    }

    /** Returns an example of the first attribute, the one that the device measures. */
    private static String measure(List<MeasuredAttribute> attributes) {
        MeasuredAttribute first = attributes.get(0);
        ObjectNode measure = NgsiJson.object();
        switch (first.type()) {
            case "Float", "Number", "Integer" -> measure.put(first.objectId(), 21);
            case "Boolean" -> measure.put(first.objectId(), true);
            default -> measure.put(first.objectId(), "");
        }
        return new String(NgsiJson.write(measure), StandardCharsets.UTF_8);
    }

    private static String quoted(String argument) {
        return "'" + argument.replace("'", "'\\''") + "'";
    }
}
