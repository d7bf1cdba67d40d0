package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlPlaneProcess;
import io.furrow.control.ControlSettings;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.fields.FieldFiles;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.Readiness;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.FarmSecret;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Runs the API with managers and a context broker for commands. */
public final class RunningApi implements AutoCloseable {
    static final Duration TIMEOUT = Duration.ofSeconds(60);
    static final FarmSecret SECRET = new FarmSecret("a secret of sixteen bytes or more".getBytes());

    private final Path directory;
    private final EmbeddedKafka kafka;
    private final ControlPlane plane;
    private final StubContextBroker broker = new StubContextBroker();
    private final RestApi api;
    private final ApiClient client;

    public RunningApi(Path directory) throws Exception {
        this.directory = directory;
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        plane = ControlPlane.start(settings());
        RestSettings rest = RestSettings.on(0)
                .withSecret(SecretSource.of(SECRET))
                .withContextBroker(broker.uri())
                .withTimeout(Duration.ofSeconds(30));
        Readiness readiness = new Readiness(Clock.systemUTC());
        readiness.require(plane::status);
        api = RestApi.start(settings(), rest, readiness, FieldFiles::read);
        client = new ApiClient(api.uri(), null);
        await().until(() -> client.status("GET", "/ready", null) == 200);
    }

    public RestApi api() {
        return api;
    }

    public ApiClient client() {
        return client;
    }

    StubContextBroker broker() {
        return broker;
    }

    /** Returns an existing resource. */
    public JsonNode get(String path) throws Exception {
        HttpResponse<byte[]> answer = client.send("GET", path, null);
        assertThat(answer.statusCode()).as(path).isEqualTo(200);
        return client.json(answer);
    }

    /** Sends a request that is rejected. The answer for an unknown path is not described. */
    public void rejects(String method, String path, String body, int status, String error) throws Exception {
        boolean described = !error.equals("not-found");
        assertThat(client.error(method, path, body, described)).isEqualTo(status + " " + error);
    }

    /** Writes a record of another program. */
    void write(String topic, String key, byte[] value) {
        try (KafkaProducer<String, byte[]> producer =
                KafkaClients.producer(settings().client())) {
            producer.send(new ProducerRecord<>(topic, key, value));
        }
    }

    public ControlSettings settings() {
        return ControlPlaneProcess.settings(
                kafka.bootstrapServers(), directory.resolve("state").toString());
    }

    @Override
    public void close() {
        api.close();
        plane.close();
        broker.close();
        kafka.close();
    }
}
