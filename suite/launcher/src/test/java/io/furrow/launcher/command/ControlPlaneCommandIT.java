package io.furrow.launcher.command;

import java.io.File;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.TimeUnit;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.Furrow;
import io.furrow.launcher.process.RestClient;
import io.furrow.launcher.suite.FarmSecretFile;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class ControlPlaneCommandIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(120);
    private static final Pattern API = Pattern.compile("REST API: (\\S+)/openapi.json");

    @TempDir
    Path directory;

    private final RestClient rest = new RestClient();
    private final List<Process> processes = new ArrayList<>();
    private EmbeddedKafka kafka;

    @BeforeEach
    void start() {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
    }

    @AfterEach
    void stop() throws Exception {
        for (Process process : processes) {
            process.destroyForcibly().waitFor();
        }
        kafka.close();
    }

    @Test
    void goesOnInAnotherProcessWhenOneIsKilledAndStopsOnRequest() throws Exception {
        Path one = directory.resolve("one");
        Path two = directory.resolve("two");
        Process first = run(one, "--standby-replicas", "1");
        Process second = run(two, "--standby-replicas", "1");
        URI firstApi = await().atMost(TIMEOUT)
                .until(() -> api(one), Optional::isPresent)
                .orElseThrow();
        URI secondApi = await().atMost(TIMEOUT)
                .until(() -> api(two), Optional::isPresent)
                .orElseThrow();

        await().atMost(TIMEOUT).until(() -> create(firstApi, "north"));
        first.destroyForcibly().waitFor();
        await().atMost(TIMEOUT).until(() -> create(secondApi, "south"));
        await().atMost(TIMEOUT)
                .untilAsserted(() -> assertThat(rest.get(URI.create(secondApi + "/api/domains"), Map.of())
                                .body())
                        .extracting(domain -> domain.path("domain").asText())
                        .containsExactly("north", "south"));

        second.destroy();
        assertThat(second.waitFor(TIMEOUT.toSeconds(), TimeUnit.SECONDS)).isTrue();
    }

    @Test
    void reportsWhatItNeedsToProvisionDevices() throws Exception {
        Process process = run(directory.resolve("out"), "--iot-agent", "http://127.0.0.1:4041");

        assertThat(process.waitFor()).isNotZero();
        assertThat(Files.readString(directory.resolve("out"))).contains("--iot-agent needs --farm-secret");
    }

    @Test
    void makesItsTopicsWithTheReplicationThatItIsGiven() throws Exception {
        Process none = run(directory.resolve("none"), "--replication-factor", "0");
        assertThat(none.waitFor()).isNotZero();
        assertThat(Files.readString(directory.resolve("none"))).contains("--replication-factor is at least 1");

        Process two = run(directory.resolve("two"), "--replication-factor", "2");
        assertThat(two.waitFor()).as("there is one broker").isNotZero();
        assertThat(Files.readString(directory.resolve("two")))
                .contains("The topics service.* cannot be prepared", "replic")
                .doesNotContain("Exception");
    }

    @Test
    void startsNoProcessWithoutTheSecretOrWithAnother() throws Exception {
        Path missing = directory.resolve("missing");
        Process process = run(directory.resolve("one"), "--farm-secret", missing.toString());
        assertThat(process.waitFor()).isNotZero();
        assertThat(Files.readString(directory.resolve("one")))
                .contains("there is no file " + missing, "./furrow secret new")
                .doesNotContain("Exception");
        assertThat(missing).doesNotExist();

        Path first = directory.resolve("first");
        Path second = directory.resolve("second");
        FarmSecretFile.make(first);
        FarmSecret another = FarmSecretFile.make(second);
        run(directory.resolve("two"), "--farm-secret", first.toString());
        await().atMost(TIMEOUT).until(() -> api(directory.resolve("two")), Optional::isPresent);
        process = run(directory.resolve("three"), "--farm-secret", second.toString());

        assertThat(process.waitFor()).isNotZero();
        assertThat(Files.readString(directory.resolve("three")))
                .contains("this farm has another secret", another.toString(), "--replace-farm-secret")
                .doesNotContain("Exception");
        assertThat(Files.readString(directory.resolve("three.log"))).doesNotContain("REBALANCING");
    }

    @Test
    void disturbsNoOtherProcessWhereItMayNotListen() throws Exception {
        Process process = run(directory.resolve("open"), "--control-host", "0.0.0.0");

        assertThat(process.waitFor()).isNotZero();
        assertThat(Files.readString(directory.resolve("open")))
                .contains("only with tokens")
                .doesNotContain("Exception");
        assertThat(directory.resolve("open.log")).as("log of what was started").doesNotExist();
    }

    /** Whether it is there now; a request is repeated under the same key until it is answered. */
    private boolean create(URI api, String domain) {
        JsonNode body = NgsiJson.mapper().createObjectNode().put("domain", domain);
        RestClient.Answer answer =
                rest.send("POST", URI.create(api + "/api/domains"), Map.of("Idempotency-Key", "r-" + domain), body);
        return answer.isSuccess();
    }

    private static Optional<URI> api(Path output) throws IOException {
        Matcher found = API.matcher(Files.readString(output));
        return found.find() ? Optional.of(URI.create(found.group(1))) : Optional.empty();
    }

    private Process run(Path output, String... further) throws IOException {
        Object[] arguments = "control-plane --kafka %s --control-port 0 --health-port 0 --log %s.log"
                .formatted(kafka.bootstrapServers(), output)
                .split(" ");
        ProcessBuilder builder = TestProcess.java("-Xmx256m", Furrow.class, arguments);
        builder.command().addAll(List.of(further));
        Process process = builder.redirectErrorStream(true)
                .redirectOutput(new File(output.toString()))
                .start();
        processes.add(process);
        return process;
    }
}
