package io.furrow.provisioner;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.TimeUnit;

import org.eclipse.paho.client.mqttv3.MqttException;

import io.furrow.embedded.FreePort;
import io.furrow.model.device.FarmSecret;
import io.furrow.process.Ports;
import io.furrow.provisioner.account.MosquittoFiles;
import io.furrow.provisioner.account.MosquittoPassword;

import static org.awaitility.Awaitility.await;

/**
 * Runs a real Mosquitto, of Debian or another that reads the same files, with the agent as its only user and an empty
 * section of Furrow in its files.
 */
final class ProvisionedMosquitto implements AutoCloseable {
    static final FarmSecret.Login AGENT = new FarmSecret.Login("agent", "plough");
    static final Duration TIMEOUT = Duration.ofSeconds(60);

    private final Path directory;
    private final int port;
    private final String reload;
    private final Runnable stop;

    /** Wraps another running broker. */
    ProvisionedMosquitto(Path directory, int port, String reload, Runnable stop) {
        this.directory = directory;
        this.port = port;
        this.reload = reload;
        this.stop = stop;
    }

    ProvisionedMosquitto(Path directory) throws IOException {
        this.directory = directory;
        this.port = FreePort.orFree(0);
        writeAgent(directory);
        Path settings = Files.writeString(directory.resolve("mosquitto.conf"), """
            listener %d 127.0.0.1
            password_file %s
            acl_file %s
            allow_anonymous false
            set_tcp_nodelay true
            log_type all
            user %s
            """.formatted(
                        port, passwords(), rules(), System.getProperty("user.name")));
        Process process = new ProcessBuilder(program(), "-c", settings.toString())
                .redirectErrorStream(true)
                .redirectOutput(log().toFile())
                .start();
        reload = "kill -HUP " + process.pid();
        stop = () -> stop(process);
        await().until(() -> Ports.isListening(port));
    }

    static void writeAgent(Path directory) throws IOException {
        Files.write(directory.resolve("passwords"), List.of(MosquittoPassword.line(AGENT)));
        Files.write(directory.resolve("rules"), List.of("user agent", "topic readwrite #"));
    }

    /** Returns its files, which it reloads after each change. */
    MosquittoFiles files() {
        return new MosquittoFiles(passwords(), rules(), reload);
    }

    Path passwords() {
        return directory.resolve("passwords");
    }

    Path log() {
        return directory.resolve("log");
    }

    Path rules() {
        return directory.resolve("rules");
    }

    /** @throws MqttException if the login is refused */
    MqttPeer connect(FarmSecret.Login login, String clientId) throws MqttException {
        return MqttPeer.connect("tcp://127.0.0.1:" + port, login, clientId);
    }

    /** Connects as soon as the login is accepted: Mosquitto reloads its files some time after the signal. */
    MqttPeer connectOnceAccepted(FarmSecret.Login login) {
        return await().ignoreExceptions().until(() -> connect(login, login.user()), MqttPeer::isConnected);
    }

    @Override
    public void close() {
        stop.run();
    }

    private static void stop(Process process) {
        process.destroy();
        try {
            if (!process.waitFor(10, TimeUnit.SECONDS)) {
                process.destroyForcibly();
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    /** Debian installs it outside of the PATH of users. */
    private static String program() {
        Path administrators = Path.of("/usr/sbin/mosquitto");
        return Files.isExecutable(administrators) ? administrators.toString() : "mosquitto";
    }
}
