package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Runs a control plane as a process beside Kafka, MongoDB and stand-ins of the FIWARE servers, sends the requests that its
 * description has as examples, and runs a command, which has its address in {@code FURROW_API}.
 */
public final class DescribedApi {
    private static final Duration TIMEOUT = Duration.ofSeconds(120);
    private static final int NOT_FOUND = 404;
    /** Each finds what those before it have created; the recording of a mission is known some seconds after its import. */
    private static final List<String> OPERATIONS = List.of(
            "createDomain",
            "changeDomain",
            "importFields",
            "changeField",
            "saveTemplate",
            "createMission",
            "addMissionDevices",
            "startMission",
            "importRecording",
            "addMarker",
            "startReplay",
            "muteAlarms");

    private final HttpClient http = HttpClient.newHttpClient();
    private final URI api;

    private DescribedApi(URI api) {
        this.api = api;
    }

    /** Arguments: folder, and the command with its arguments. */
    public static void main(String... args) {
        JavaProcess.killChildrenAtExit();
        try {
            System.exit(run(args));
        } catch (Exception e) { // the servers would keep the process alive
            e.printStackTrace();
            System.exit(1);
        }
    }

    private static int run(String... args) throws Exception {
        Path folder = Path.of(args[0]);
        EmbeddedKafka kafka = EmbeddedKafka.start(folder.resolve("kafka"));
        EmbeddedMongo mongo = EmbeddedMongo.inMemory();
        FiwareStandIn fiware = FiwareStandIn.start(new FiwareSettings(0, 0, null, null, null));
        List<String> options = ControlPlaneOptions.provisioning(folder, fiware.contextBroker(), fiware.iotAgent());
        options.addAll(List.of("--mongo", mongo.uri(), "--start-timeout", "5s"));
        ControlProcess control = new ControlProcess(
                folder, "control", new ControlProcess.Settings(kafka.bootstrapServers(), "512m", options));
        control.start();
        Until.isTrue("the control plane is ready", TIMEOUT, control::isReady);
        write(kafka.bootstrapServers());
        new DescribedApi(control.api()).sendExamples();
        ProcessBuilder command = new ProcessBuilder(List.of(args).subList(1, args.length)).inheritIO();
        command.environment().put("FURROW_API", control.api().toString());
        return command.start().waitFor();
    }

    /** Writes what is not written over REST. */
    private static void write(String bootstrapServers) {
        Properties client = new Properties();
        client.setProperty("bootstrap.servers", bootstrapServers);
        try (KafkaProducer<String, byte[]> producer = KafkaClients.producer(client)) {
            ProducerRecord<String, byte[]> letter =
                    new ProducerRecord<>(Topics.dead("data.raw"), "k", "{\"half\":".getBytes(UTF_8));
            Map.of("dead-reason", "not-json", "dead-stage", "normalize", "dead-source", "data.raw-0@0")
                    .forEach((name, text) -> letter.headers().add(name, text.getBytes(UTF_8)));
            producer.send(letter);
            producer.send(new ProducerRecord<>(
                    Topics.CATALOG,
                    "farm|north|weeding|Thermometer",
                    "{\"domain\":\"north\",\"mission\":\"weeding\",\"type\":\"Thermometer\"}".getBytes(UTF_8)));
        }
    }

    private void sendExamples() throws IOException, InterruptedException {
        JsonNode description = Http.get(api.resolve("/openapi.json")).body();
        for (String operation : OPERATIONS) {
            Until.isTrue(operation + " finds what it needs", TIMEOUT, () -> send(description, operation) != NOT_FOUND);
        }
    }

    private int send(JsonNode description, String operationId) {
        for (Map.Entry<String, JsonNode> path : description.path("paths").properties()) {
            for (Map.Entry<String, JsonNode> method : path.getValue().properties()) {
                if (method.getValue().path("operationId").asText().equals(operationId)) {
                    Map.Entry<String, JsonNode> body = method.getValue()
                            .at("/requestBody/content")
                            .properties()
                            .iterator()
                            .next();
                    HttpRequest request = HttpRequest.newBuilder(
                                    api.resolve(named(description, path.getKey(), method.getValue())))
                            .header("Content-Type", body.getKey())
                            .method(
                                    method.getKey().toUpperCase(java.util.Locale.ROOT),
                                    HttpRequest.BodyPublishers.ofString(example(description, body.getValue())))
                            .build();
                    return status(request);
                }
            }
        }
        throw new IllegalArgumentException("there is no operation " + operationId);
    }

    private int status(HttpRequest request) {
        try {
            HttpResponse<String> answer = http.send(request, HttpResponse.BodyHandlers.ofString());
            if (answer.statusCode() >= 300 && answer.statusCode() != NOT_FOUND) {
                throw new IllegalStateException(request + " is refused: " + answer.body());
            }
            return answer.statusCode();
        } catch (IOException e) {
            throw new java.io.UncheckedIOException(e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException(e);
        }
    }

    /** Returns a path with the examples of its parameters. */
    private static String named(JsonNode description, String path, JsonNode operation) {
        String named = path;
        for (JsonNode parameter : operation.path("parameters")) {
            JsonNode resolved = resolved(description, parameter);
            named = named.replace(
                    "{" + resolved.path("name").asText() + "}",
                    resolved.path("example").asText());
        }
        return named;
    }

    private static String example(JsonNode description, JsonNode body) {
        JsonNode example = body.has("example")
                ? body.get("example")
                : resolved(description, body.path("schema")).at("/examples/0");
        return example.isTextual() ? example.textValue() : example.toString();
    }

    private static JsonNode resolved(JsonNode description, JsonNode node) {
        return node.has("$ref") ? description.at(node.path("$ref").asText().substring(1)) : node;
    }
}
