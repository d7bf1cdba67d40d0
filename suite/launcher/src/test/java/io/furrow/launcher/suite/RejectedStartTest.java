package io.furrow.launcher.suite;

import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.embedded.FreePort;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Why servers do not start: ports, other servers, directories, secrets. */
class RejectedStartTest extends CommandLineFixture {
    @Test
    void namesThePortInUseAndTheOptionThatChoosesAnother() throws Exception {
        try (ServerSocket taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            String port = Integer.toString(taken.getLocalPort());

            assertThat(refusal("up", "--kafka-port", "0", "--connect-port", "0", "--flink-port", port)
                            .trim())
                    .isEqualTo("Port " + port
                            + " of 127.0.0.1, meant for Flink's web UI, is in use. Stop what listens there, "
                            + "or choose another with --flink-port.");
        }
    }

    @Test
    void namesAllPortsInUseAtOnce() throws Exception {
        try (ServerSocket one = new ServerSocket(0, 1, InetAddress.getLoopbackAddress());
                ServerSocket two = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            String first = Integer.toString(one.getLocalPort());
            String second = Integer.toString(two.getLocalPort());

            assertThat(refusal(upOnPorts(first, second)).trim())
                    .isEqualTo(
                            "These ports are in use: %s of 127.0.0.1 for Flink's web UI (--flink-port), %s of 127.0.0.1 for the MQTT broker (--mqtt-port). Stop what listens there, or choose others with the options in brackets."
                                    .formatted(first, second));
        }
    }

    @Test
    void rejectsOnePortForTwoParts() {
        String port = Integer.toString(FreePort.orFree(0));

        assertThat(refusal(upOnPorts(port, port)))
                .startsWith("Port " + port + " of 127.0.0.1, meant for the MQTT broker");
    }

    @Test
    void namesAllServersThatDoNotAnswerBeforeAnythingStarts() {
        String silent = "127.0.0.1:" + FreePort.orFree(0);

        assertThat(refusal(with(
                                upOnFreePorts(directory.resolve("data")),
                                "--orion",
                                "http://" + silent,
                                "--iot-agent",
                                "http://no-such-host.invalid:4041",
                                "--mqtt",
                                "tcp://" + silent,
                                "--mongo",
                                "mongodb://me:s3cret@" + silent,
                                "--kafka",
                                silent))
                        .lines())
                .containsExactly(
                        "--orion http://%s: the context broker does not answer there (Connection refused). Start it, or name another address."
                                .formatted(silent),
                        "--iot-agent http://no-such-host.invalid:4041: the IoT Agent does not answer there (there is no host of this name). Start it, or name another address.",
                        "--mqtt tcp://%s: the MQTT broker does not answer there (Connection refused). Start it, or name another address."
                                .formatted(silent),
                        "--mongo %s: MongoDB does not answer there (nothing within 3 s). Start it, or name another address."
                                .formatted(silent),
                        "--kafka %s: Kafka does not answer there (nothing within 3 s). Start it, or name another address."
                                .formatted(silent));
        assertThat(out.toString()).doesNotContain("starting");
    }

    @Test
    void rejectsADirectoryThatKafkaWouldDivide() {
        assertThat(refusal(upOnFreePorts(directory.resolve("a,b"))))
                .startsWith("--data " + directory + "/a,b has a comma")
                .hasLineCount(1);
    }

    @Tag("full")
    @ParameterizedTest
    @ValueSource(strings = {"control-plane --control-port 0 --health-port 0", "dashboard --port 0 --log /dev/null"})
    void reportsThatItWaitsForKafka(String arguments) throws Exception {
        String silent = "127.0.0.1:" + FreePort.orFree(0);
        Thread command = new Thread(() -> furrow.execute(with(arguments.split(" "), "--kafka", silent)));
        command.start();
        try {
            await().untilAsserted(() -> assertThat(err.toString())
                    .startsWith("Kafka at %s does not answer (nothing within 3 s). Check --kafka".formatted(silent))
                    .hasLineCount(1));
        } finally {
            command.interrupt();
            command.join();
        }
    }

    @ParameterizedTest
    @CsvSource({
        "dashboard, --port",
        "control-plane --health-port 0, --control-port",
        "control-plane --control-port 0, --health-port"
    })
    void namesItOfAPartThatRunsAloneToo(String command, String option) throws Exception {
        try (ServerSocket taken = new ServerSocket(0, 1, InetAddress.getLoopbackAddress())) {
            assertThat(refusal(with(
                                    command.split(" "),
                                    "--kafka",
                                    "127.0.0.1:1",
                                    option,
                                    Integer.toString(taken.getLocalPort())))
                            .trim())
                    .startsWith("Port %d of 127.0.0.1, meant for ".formatted(taken.getLocalPort()))
                    .endsWith("or choose another with %s.".formatted(option))
                    .hasLineCount(1);
        }
    }

    @Test
    void reportsThatADirectoryCannotBeWritten() throws Exception {
        Path file = Files.createFile(directory.resolve("file"));

        assertThat(refusal(upOnFreePorts(file.resolve("below"))).trim())
                .startsWith("Cannot write in %s (%s is not a directory)".formatted(file.resolve("below"), file))
                .endsWith("Name a directory that you may write with --data.")
                .hasLineCount(1);
    }

    @Test
    void rejectsASecondSuiteInTheSameDirectory() {
        try (RunDirectory held = RunDirectory.open(directory)) {
            assertThat(furrow.execute(upOnFreePorts(held.path()))).isNotZero();
        }
        assertThat(err.toString()).contains("Another Furrow uses " + directory);
    }

    @Test
    void doesNotStartOnTheDataOfAFarmWithoutItsSecret() throws Exception {
        Path data = Files.createDirectories(directory.resolve("data/kafka")).getParent();

        assertThat(refusal(upOnFreePorts(data)).trim())
                .startsWith(data + " has the data of a farm but not its secret")
                .hasLineCount(1);
        assertThat(data.resolve("kafka")).isEmptyDirectory();
    }

    @ParameterizedTest
    @ValueSource(strings = {"--kafka 127.0.0.1:1", "--orion http://127.0.0.1:1 --iot-agent http://127.0.0.1:1"})
    void makesNoSecretThatEndsBeforeWhatIsMadeWithIt(String arguments) {
        List<String> up = new ArrayList<>(List.of(upOnFreePorts(directory)));
        int data = up.indexOf("--data");
        up.remove(data);
        up.remove(data);
        up.addAll(List.of(arguments.split(" ")));

        assertThat(refusal(up.toArray(String[]::new)).trim())
                .startsWith("Without --data the farm's secret would be deleted at the end")
                .endsWith("./furrow secret new FILE makes one.")
                .hasLineCount(1);
    }
}
