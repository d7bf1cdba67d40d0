package io.furrow.simulators.host;

import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.device.FarmSecret;
import io.furrow.process.TestProcess;
import io.furrow.simulators.device.MqttTestClient;

import static io.furrow.simulators.host.HostFixture.entity;
import static io.furrow.simulators.host.HostFixture.topic;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The host as a process of its own. */
@Tag("full")
class KilledHostIT {
    private static final String YARD = "{\"path\": [[-3.48, 40.31]]}";

    @TempDir
    private Path directory;

    private HostFixture bench;
    private final List<Process> processes = new ArrayList<>();

    @BeforeEach
    void start() throws Exception {
        bench = new HostFixture(directory.resolve("kafka"));
    }

    @AfterEach
    void stop() throws Exception {
        for (Process process : processes) {
            process.destroyForcibly().waitFor();
        }
        bench.close();
    }

    @Test
    void takesUpWhatWasDesiredWhileItWasDead() throws Exception {
        String remaining = entity("Thermometer", "killed", 1);
        String stopped = entity("Thermometer", "killed", 2);
        String comes = entity("Thermometer", "killed", 3);
        bench.admit("killed", remaining);
        bench.admit("killed", stopped);
        bench.admit("killed", comes);
        long first = bench.addDesired("killed", remaining, true, YARD);
        long second = bench.addDesired("killed", stopped, true, YARD);
        Process host = host();
        await().untilAsserted(() -> {
            assertThat(bench.status(remaining)).contains(new DeviceStatus(first, State.RUNNING, null));
            assertThat(bench.status(stopped)).contains(new DeviceStatus(second, State.RUNNING, null));
        });

        host.destroyForcibly().waitFor();
        long end = bench.addDesired("killed", stopped, false, YARD);
        long begin = bench.addDesired("killed", comes, true, YARD);
        host();

        await().untilAsserted(() -> {
            assertThat(bench.status(remaining)).contains(new DeviceStatus(first, State.RUNNING, null));
            assertThat(bench.status(stopped)).contains(new DeviceStatus(end, State.STOPPED, null));
            assertThat(bench.status(comes)).contains(new DeviceStatus(begin, State.RUNNING, null));
        });
        try (MqttTestClient listener = bench.listener()) {
            await().untilAsserted(() -> {
                assertThat(listener.received(topic("killed", remaining, "attrs")))
                        .isNotEmpty();
                assertThat(listener.received(topic("killed", comes, "attrs"))).isNotEmpty();
            });
            assertThat(listener.received(topic("killed", stopped, "attrs"))).isEmpty();
        }
    }

    @Test
    void endsWithASentenceWhereTheSecretIsTooShort() throws Exception {
        Path secret = Files.writeString(directory.resolve("short"), "plough");
        Process process = run(secret, "host-with-a-short-secret");

        assertThat(process.waitFor()).isEqualTo(1);
        assertThat(Files.readString(directory.resolve("host-with-a-short-secret.log")))
                .contains("short: a farm's secret has at least 16 bytes");
    }

    @Test
    void endsWithASentenceWhereTheFarmHasAnotherSecret() throws Exception {
        bench.putFingerprints(FarmSecret.generate());
        bench.addDesired("killed", entity("Thermometer", "killed", 1), true, YARD);

        Process host = host();

        assertThat(host.waitFor()).isEqualTo(1);
        assertThat(Files.readString(directory.resolve("host-0.log")))
                .contains(
                        "this farm has another secret",
                        HostFixture.SECRET.toString(),
                        "a copy of the control plane's file");
        assertThat(bench.statuses()).isEmpty();
    }

    @Test
    void endsWithASentenceWhereThereIsNoSecret() throws Exception {
        Process process = run(directory.resolve("missing"), "host-without-a-secret");

        assertThat(process.waitFor()).isEqualTo(1);
        assertThat(Files.readString(directory.resolve("host-without-a-secret.log")))
                .contains("there is no file " + directory.resolve("missing"), "./furrow secret new")
                .doesNotContain("Exception");
    }

    private Process host() throws Exception {
        return run(Files.writeString(directory.resolve("secret"), HostFixture.SECRET_TEXT), "host-" + processes.size());
    }

    private Process run(Path secret, String name) throws Exception {
        URI mqtt = bench.settings().mqtt().broker();
        ProcessBuilder builder =
                TestProcess.java("-Xmx256m", DeviceHostCommand.class, "--mqtt", mqtt, "--farm-secret", secret);
        builder.environment().put("FURROW_KAFKA", bench.kafka.bootstrapServers());
        builder.environment()
                .put("FURROW_CONTEXT_BROKER", bench.fiware.contextBroker().toString());
        Process process = builder.redirectErrorStream(true)
                .redirectOutput(directory.resolve(name + ".log").toFile())
                .start();
        processes.add(process);
        return process;
    }
}
