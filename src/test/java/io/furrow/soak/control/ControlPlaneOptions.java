package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.FarmSecretCodec;
import io.furrow.model.file.PrivateFile;

/** Options of the control plane's command for the servers that it uses. */
final class ControlPlaneOptions {
    private ControlPlaneOptions() {}

    /** Options for a context broker and an IoT Agent. */
    static List<String> provisioning(Path folder, FiwareStandIn fiware) throws IOException {
        return provisioning(folder, fiware.contextBroker(), fiware.iotAgent());
    }

    static List<String> provisioning(Path folder, URI contextBroker, URI iotAgent) throws IOException {
        return new ArrayList<>(List.of(
                "--orion", contextBroker.toString(),
                "--iot-agent", iotAgent.toString(),
                "--iot-agent-interval", "5s",
                "--farm-secret", secret(folder).toString()));
    }

    /** Options for MQTT accounts in the files of a Mosquitto. */
    static List<String> accounts(MosquittoProcess mosquitto) {
        return List.of(
                "--mqtt-password-file", mosquitto.passwords().toString(),
                "--mqtt-acl-file", mosquitto.rules().toString(),
                "--mqtt-reload", mosquitto.reload());
    }

    static List<String> webhook(URI url) {
        return List.of("--webhook", url.toString());
    }

    /** The farm's secret, the same in each call. */
    static Path secret(Path folder) throws IOException {
        Path file = folder.resolve("farm-secret");
        if (Files.notExists(file)) {
            Files.createDirectories(folder);
            PrivateFile.create(file, FarmSecretCodec.write(FarmSecret.generate()));
        }
        return file;
    }
}
