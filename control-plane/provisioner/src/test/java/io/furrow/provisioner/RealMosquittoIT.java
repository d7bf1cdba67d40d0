package io.furrow.provisioner;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.testcontainers.DockerClientFactory;
import org.testcontainers.containers.BindMode;
import org.testcontainers.containers.GenericContainer;

import io.furrow.containers.PinnedService;

import static org.junit.jupiter.api.Assumptions.abort;

/** Uses the written files with the image, script and settings of Mosquitto in {@code docker/compose.yaml}. */
@Tag("containers")
class RealMosquittoIT extends MosquittoIT {
    private static final String NO_ENGINE =
            "there is no container engine; whom Mosquitto's image lets in was not tried";
    private static final Path SCRIPTS =
            Path.of("..", "..", "docker", "mosquitto").toAbsolutePath();
    private static final int PORT = 1883;

    @RegisterExtension
    static final BeforeAllCallback NEEDS_AN_ENGINE = context -> {
        if (!DockerClientFactory.instance().isDockerAvailable()) {
            System.out.println("RealMosquittoIT was NOT RUN: " + NO_ENGINE);
            abort(NO_ENGINE);
        }
    };

    @Override
    ProvisionedMosquitto start(Path folder) throws Exception {
        ProvisionedMosquitto.writeAgent(folder);
        // If the tests run as root, Mosquitto would switch to a user that may not read their files.
        Files.writeString(
                folder.resolve("mosquitto.conf"), Files.readString(SCRIPTS.resolve("mosquitto.conf")) + "user root\n");
        String user = Files.getAttribute(folder, "unix:uid").toString();
        GenericContainer<?> container = new GenericContainer<>(
                        PinnedService.of("mosquitto").image())
                .withCommand("/furrow/run", "/mosquitto/config/mosquitto.conf", "/mosquitto/config")
                .withEnv(Map.of("MQTT_PASSWORD", "harrow", "XDG_CONFIG_HOME", "/tmp"))
                .withFileSystemBind(SCRIPTS.toString(), "/furrow", BindMode.READ_ONLY)
                .withFileSystemBind(folder.toString(), "/mosquitto/config", BindMode.READ_WRITE)
                .withTmpFs(Map.of("/mosquitto/data", "rw,mode=1777", "/mosquitto/log", "rw,mode=1777"))
                .withCreateContainerCmdModifier(command -> command.withUser(user))
                .withExposedPorts(PORT);
        container.start();
        return new ProvisionedMosquitto(folder, container.getMappedPort(PORT), "true", container::stop);
    }
}
