package io.furrow.control.provisioning;

import java.io.IOException;
import java.net.InetAddress;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;

import org.eclipse.paho.client.mqttv3.MqttClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.FreePort;
import io.furrow.model.device.FarmSecret;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** The written files in a real Mosquitto, as Debian packs it, that reads them again while it runs. */
class MosquittoIT {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final FarmSecret.Login AGENT = new FarmSecret.Login("agent", "plough");
    private static final FarmSecret SECRET = Wanted.SECRET;
    private static final String KEY = "/" + SECRET.apiKey("hoeing");
    private static final String OTHER_KEY = "/" + SECRET.apiKey("weeding");
    /** With signs that mean something in the files. */
    private static final String DEVICE = "urn:ngsi-ld:Thermometer:hoeing-1";

    @TempDir
    Path directory;

    private final int port = FreePort.orFree(0);
    private Process broker;
    private MosquittoFiles files;
    private Heard heard;

    @BeforeEach
    void startWithTheAgentAsItsOnlyUser() throws Exception {
        Files.write(path("passwords"), List.of(MosquittoPassword.line(AGENT)));
        Files.write(path("rules"), List.of("user agent", "topic readwrite #"));
        Files.writeString(path("mosquitto.conf"), """
                listener %d 127.0.0.1
                password_file %s
                acl_file %s
                allow_anonymous false
                set_tcp_nodelay true
                user %s
                """.formatted(
                        port, path("passwords"), path("rules"), System.getProperty("user.name")));
        broker = new ProcessBuilder(program(), "-c", path("mosquitto.conf").toString())
                .redirectErrorStream(true)
                .redirectOutput(path("log").toFile())
                .start();
        await().atMost(PATIENCE).until(this::isListening);
        files = new MosquittoFiles(path("passwords"), path("rules"), "kill -HUP " + broker.pid());
        heard = new Heard(connect(AGENT, "agent"), "#");
        files.replace(List.of(
                MqttAccount.gateway(SECRET, "hoeing"),
                MqttAccount.device(SECRET, "hoeing", DEVICE),
                MqttAccount.device(SECRET, "weeding", "other")));
    }

    @AfterEach
    void stop() throws Exception {
        heard.close();
        broker.destroy();
        if (!broker.waitFor(10, TimeUnit.SECONDS)) {
            broker.destroyForcibly();
        }
    }

    @Test
    void letsADeviceInWithItsPasswordAndWithNoOther() throws Exception {
        FarmSecret.Login right = SECRET.device("hoeing", DEVICE);
        try (Heard device = comesIn(right)) {
            device.publish(KEY + "/" + DEVICE + "/attrs", "1");
            await().atMost(PATIENCE)
                    .until(() -> heard.of(KEY + "/" + DEVICE + "/attrs").equals("1"));
        }
        FarmSecret.Login guessed =
                new FarmSecret.Login(right.user(), SECRET.device("hoeing", "d").password());
        assertThatThrownBy(() -> connect(guessed, "guess"))
                .isInstanceOf(MqttException.class)
                .hasMessageContaining("Not authorized");
    }

    @Test
    void letsADevicePublishAsItselfOnly() throws Exception {
        try (Heard device = comesIn(SECRET.device("hoeing", DEVICE))) {
            List<String> foreign = List.of(
                    KEY + "/urn:ngsi-ld:Thermometer:hoeing-2/attrs",
                    OTHER_KEY + "/" + DEVICE + "/attrs",
                    "/json" + OTHER_KEY + "/other/attrs",
                    KEY + "/" + DEVICE + "/cmd");
            for (String topic : foreign) {
                device.publish(topic, "forged");
            }
            device.publish("/json" + KEY + "/" + DEVICE + "/attrs", "2");

            // One connection keeps its order: what was forged would have come before.
            await().atMost(PATIENCE)
                    .until(() ->
                            heard.of("/json" + KEY + "/" + DEVICE + "/attrs").equals("2"));
            assertThat(foreign).allSatisfy(topic -> assertThat(heard.of(topic)).isEmpty());
        }
    }

    @Test
    void letsADeviceHearItsOwnCommandsOnly() throws Exception {
        try (Heard device = comesIn(SECRET.device("hoeing", DEVICE))) {
            device.listen("#");
            device.listen(KEY + "/" + DEVICE + "/cmd");
            heard.publish(KEY + "/urn:ngsi-ld:Thermometer:hoeing-2/cmd", "on");
            heard.publish(KEY + "/" + DEVICE + "/attrs", "3");
            heard.publish(KEY + "/" + DEVICE + "/cmd", "off");

            await().atMost(PATIENCE)
                    .until(() -> device.of(KEY + "/" + DEVICE + "/cmd").equals("off"));
            assertThat(device.topics()).containsOnly(KEY + "/" + DEVICE + "/cmd");
        }
    }

    @Test
    void letsAGatewaySpeakForItsOwnMissionOnly() throws Exception {
        try (Heard gateway = comesIn(SECRET.gateway("hoeing"))) {
            gateway.publish(OTHER_KEY + "/other/attrs", "forged");
            gateway.publish(KEY + "/any/attrs", "4");
            gateway.listen(KEY + "/+/cmd");
            heard.publish(KEY + "/any/cmd", "on");

            await().atMost(PATIENCE).until(() -> heard.of(KEY + "/any/attrs").equals("4"));
            await().atMost(PATIENCE).until(() -> gateway.of(KEY + "/any/cmd").equals("on"));
            assertThat(heard.of(OTHER_KEY + "/other/attrs")).isEmpty();
        }
    }

    @Test
    void shutsADeviceOutThatIsNoLongerWantedAndKeepsTheAgent() throws Exception {
        try (Heard device = comesIn(SECRET.device("hoeing", DEVICE))) {
            files.replace(List.of());

            await().atMost(PATIENCE).until(() -> !device.isConnected());
            assertThatThrownBy(() -> connect(SECRET.device("hoeing", DEVICE), "again"))
                    .isInstanceOf(MqttException.class);
            assertThat(heard.isConnected()).isTrue();
        }
    }

    /** Mosquitto reads its files a moment after it is told to. */
    private Heard comesIn(FarmSecret.Login login) throws MqttException {
        return new Heard(await().atMost(PATIENCE)
                .ignoreExceptions()
                .until(() -> connect(login, "device"), MqttClient::isConnected));
    }

    private MqttClient connect(FarmSecret.Login login, String id) throws MqttException {
        MqttClient client = new MqttClient("tcp://127.0.0.1:" + port, id, new MemoryPersistence());
        MqttConnectOptions options = new MqttConnectOptions();
        options.setUserName(login.user());
        options.setPassword(login.password().toCharArray());
        try {
            client.connect(options);
            return client;
        } catch (MqttException e) {
            client.close();
            throw e;
        }
    }

    private boolean isListening() {
        try (Socket socket = new Socket(InetAddress.getLoopbackAddress(), port)) {
            return socket.isConnected();
        } catch (IOException e) {
            return false;
        }
    }

    private Path path(String name) {
        return directory.resolve(name);
    }

    /** Debian has it where only administrators look for programs. */
    private static String program() {
        Path administrators = Path.of("/usr/sbin/mosquitto");
        return Files.isExecutable(administrators) ? administrators.toString() : "mosquitto";
    }

    /** A client, and the newest message of each topic that it has heard. */
    private static final class Heard implements AutoCloseable {
        private final MqttClient client;
        private final Map<String, String> newest = new ConcurrentHashMap<>();

        Heard(MqttClient client, String... filters) throws MqttException {
            this.client = client;
            for (String filter : filters) {
                listen(filter);
            }
        }

        void listen(String filter) throws MqttException {
            client.subscribe(
                    filter,
                    1,
                    (topic, message) -> newest.put(topic, new String(message.getPayload(), StandardCharsets.UTF_8)));
        }

        void publish(String topic, String message) throws MqttException {
            client.publish(topic, message.getBytes(StandardCharsets.UTF_8), 1, false);
        }

        String of(String topic) {
            return newest.getOrDefault(topic, "");
        }

        Iterable<String> topics() {
            return newest.keySet();
        }

        boolean isConnected() {
            return client.isConnected();
        }

        @Override
        public void close() throws MqttException {
            if (client.isConnected()) {
                client.disconnect();
            }
            client.close();
        }
    }
}
