package io.furrow.launcher.suite;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Stream;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;

import io.furrow.embedded.FreePort;
import io.furrow.launcher.Furrow;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class CommandLineTest {
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();
    private final CommandLine furrow =
            Furrow.commandLine().setOut(new PrintWriter(out)).setErr(new PrintWriter(err));

    @TempDir
    Path directory;

    @ParameterizedTest
    @CsvSource({
        "--help, demo",
        "help mission, watch",
        "--version, furrow",
        "init --help, FILE",
        "demo --help, --kafka-port",
        "up --help, --orion",
        "demo --help, --tiles",
        "dead-letters redrive --help, --dry-run",
        "control-plane --help, --standby-replicas",
        "scenario --help, --qos",
        "device-host --help, --farm-secret",
        "secret rotate --help, --keep-old",
        "device rotate --help, DEVICE",
        "control-plane --help, --api-certificate",
        "domain create --help, --area",
        "mission --help, watch",
        "mission start --help, --duration",
        "mission export --help, --mongo",
        "template import --help, FILE",
        "device list --help, --mission",
        "alarm mute --help, --for",
        "audit --help, --since",
        "status --help, dead letters",
        "mission stop --help, --all",
        "mission purge --help, admins",
        "alarm list --help, Example: ./furrow alarm list --since -24h",
        "topic find --help, --attribute",
        "device tail --help, --follow",
        "replay start --help, --speed",
        "replay compare --help, Exit code",
        "replay analytics --help, --flink-url",
        "replay watch --help, space",
        "replay loop --help, --off",
        "mission marker add --help, NOTE"
    })
    void explainsItself(String arguments, String mentioned) {
        assertThat(furrow.execute(arguments.split(" "))).isZero();
        assertThat(out.toString()).contains(mentioned);
    }

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

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--listen 0.0.0.0|--listen 0.0.0.0 lets anyone who reaches it report",
                "--listen 0.0.0.0 --notify-secret pom.xml|--listen 0.0.0.0 lets other machines in without TLS",
                "--mqtt-listen 0.0.0.0|--mqtt-listen 0.0.0.0 lets other machines in without TLS",
                "--mqtt-listen 0.0.0.0 --orion http://127.0.0.1:1026|--mqtt-listen is of the suite's own MQTT broker",
                "--listen 0.0.0.0 --notify-secret pom.xml --listen-insecure --orion http://127.0.0.1:1026|--listen 0.0.0.0 is every address",
                "--orion http://192.0.2.1:1026|The context broker of --orion http://192.0.2.1:1026 is on another machine",
                "--listen 0.0.0.0 --notify-secret /nowhere/x --listen-insecure|--notify-secret: /nowhere/x cannot be read",
                "--fiware-service-path north|--fiware-service-path north is none",
                "--fiware-token-header X-Farm|--fiware-token-header needs --fiware-token-file",
                "--fiware-token-file /nowhere/token|--fiware-token-file: /nowhere/token cannot be read",
                "--mqtt x --orion http://127.0.0.1:1026|--mqtt: x is not an address of an MQTT broker",
                "--mongo x|--mongo: ",
            })
    void rejectsWhatCannotWorkOrIsOpenToAnybody(String options, String sentence) {
        assertThat(refusal(with(upOnFreePorts(directory), options.split(" "))))
                .startsWith(sentence)
                .hasLineCount(1);
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--tiles https://tiles.example.org/map.png|--tiles https://tiles.example.org/map.png names no tile",
                "--tiles /nowhere/farm.pmtiles|--tiles /nowhere/farm.pmtiles: there is no such file",
                "--tiles a --tiles b|--tiles a, b: give one file only",
            })
    void rejectsBaseMapsThatAreNone(String options, String sentence) {
        assertThat(refusal(with(upOnFreePorts(directory), options.split(" "))))
                .startsWith(sentence);
    }

    @Test
    void rejectsADirectoryThatKafkaWouldDivide() {
        assertThat(refusal(upOnFreePorts(directory.resolve("a,b"))))
                .startsWith("--data " + directory + "/a,b has a comma")
                .hasLineCount(1);
    }

    @Test
    void joinsNoKafkaThatNobodyNamed() {
        assertThat(furrow.execute("control-plane")).isEqualTo(2);

        assertThat(err.toString()).contains("--kafka");
    }

    @Test
    void startsServersWithoutAContext() {
        CommandLine replay = furrow.getSubcommands().get("replay");

        assertThat(List.of(
                        furrow.getSubcommands().get("up"),
                        furrow.getSubcommands().get("control-plane"),
                        replay.getSubcommands().get("analytics")))
                .allSatisfy(
                        server -> assertThat(server.getDefaultValueProvider()).isNull());
        assertThat(replay.getSubcommands().get("compare").getDefaultValueProvider())
                .isNotNull();
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

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--iot-agent-resource|/iot/d|--iot-agent-interval need --iot-agent",
                "--mqtt-password-file=passwords|--mqtt-acl-file=rules|--mqtt-reload and --mqtt-log need --iot-agent",
                "--mqtt-public-url=farm.lan|--fiware-service=farm|must be mqtt://host",
                "--iot-agent=http://127.0.0.1:4041|--iot-agent-resource=json|must be empty or begin with '/'",
                "--iot-agent=http://127.0.0.1:4041|--iot-agent-interval=0s|at least a second",
                "--iot-agent=http://127.0.0.1:4041|--fiware-service=|name one with --fiware-service",
            })
    void rejectsSettingsOfAnIotAgentThatCannotBeRight(String first, String second, String sentence) {
        for (String command :
                List.of("up", "control-plane --kafka 127.0.0.1:1 --farm-secret x --log " + directory.resolve("log"))) {
            assertThat(refusal(with(command.split(" "), first, second)))
                    .contains(sentence)
                    .hasLineCount(1);
        }
    }

    @Test
    void rejectsAnIotAgentWithoutItsContextBroker() {
        assertThat(refusal("up", "--iot-agent=http://127.0.0.1:4041"))
                .startsWith("--iot-agent needs --orion")
                .hasLineCount(1);
    }

    @ParameterizedTest
    @CsvSource({
        "up --allowed-hosts farm.example.org:8085, --allowed-hosts, farm.example.org:8085' is not a host",
        "demo --allowed-origins map.example.org, --allowed-origins, map.example.org' is not an origin",
        "control-plane --allowed-hosts http://farm, --allowed-hosts, http://farm' is not a host"
    })
    void rejectsNamesOfItsServersThatAreNone(String arguments, String option, String why) {
        assertThat(refusal(arguments.split(" "))).contains(option, why);
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

    @ParameterizedTest
    @CsvSource({
        "control-plane --iot-agent localhost:4041 --farm-secret x, --iot-agent",
        "control-plane --orion localhost:1026, --orion",
        "up --orion 127.0.0.1, --orion",
        "up --orion http://127.0.0.1:1026 --iot-agent ftp://127.0.0.1:4041, --iot-agent",
        "domain list --api localhost:8085, --api"
    })
    void rejectsAnAddressThatIsNoHttpUrl(String arguments, String option) {
        assertThat(furrow.execute(arguments.split(" "))).isEqualTo(2);
        assertThat(err.toString()).contains(option, "cannot be used, because");
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

    @Test
    void rejectsAnUnknownOptionInOneSentence() {
        assertThat(refusal("demo", "--orin", "x")).contains("Unknown options: '--orin', 'x'", "furrow demo --help");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            missions list          | Did you mean: furrow mission
            mission lists          | Did you mean: mission list
            mission list --ouput=x | Possible solutions: --output
            ``                     | dead-letters
            mission                | add-devices
            """)
    void leadsToTheRightCommand(String arguments, String lead) {
        String[] words = arguments.equals("``") ? new String[0] : arguments.split(" ");

        assertThat(furrow.execute(words)).isEqualTo(2);

        assertThat(err.toString()).contains(lead).doesNotContain("Missing required");
    }

    @Test
    void completesValuesAsTheyAreWritten() {
        assertThat(furrow.execute("generate-completion")).isZero();

        assertThat(out.toString())
                .contains("(\"table\" \"wide\" \"json\"", "(\"open\" \"acknowledged\"")
                .doesNotContain("\"TABLE\"", "\"OPEN\"", "\"JSONL\"");
    }

    @ParameterizedTest
    @CsvSource({
        "hooks.example.com/x, no scheme", "localhost:8080/x, http", "ftp://hooks.example.com/x, http",
        "http:///x, host", "https://, not a URI", "http://a b/x, not a URI"
    })
    void refusesToStartWithAWebhookThatCannotBeReached(String webhook, String reason) {
        for (String command : new String[] {"up", "control-plane"}) {
            err.getBuffer().setLength(0);
            assertThat(furrow.execute(command, "--kafka", "127.0.0.1:1", "--webhook", webhook))
                    .isEqualTo(2);
            assertThat(err.toString()).contains("--webhook", webhook, reason);
        }
    }

    @Test
    void refusesToStartWithAWebhookSecretThatIsNone() throws Exception {
        Path tooShort = Files.writeString(directory.resolve("short"), "short\n");
        String[] common = {"control-plane", "--kafka", "127.0.0.1:1"};
        assertThat(refusal(with(common, "--webhook-secret", tooShort.toString())))
                .contains("name that too");
        assertThat(refusal(with(common, "--webhook", "https://example.com/x", "--webhook-secret", tooShort.toString())))
                .contains("--webhook-secret: " + tooShort, "holds no secret", "openssl rand");
    }

    @Test
    void rejectsShareOfSilentDevicesThatIsNone() {
        assertThat(refusal("control-plane", "--kafka", "127.0.0.1:1", "--silent-share", "0"))
                .contains("--silent-share", "0.0");
    }

    /** What it says of a command line that it does not carry out. */
    private String refusal(String... arguments) {
        err.getBuffer().setLength(0);
        assertThat(furrow.execute(arguments)).isNotZero();
        return err.toString();
    }

    private static String[] with(String[] some, String... more) {
        return Stream.of(some, more).flatMap(Stream::of).toArray(String[]::new);
    }

    private String[] upOnPorts(String flink, String mqtt) {
        return String.join(" ", upOnFreePorts(directory))
                .replace("--flink-port 0", "--flink-port " + flink)
                .replace("--mqtt-port 0", "--mqtt-port " + mqtt)
                .split(" ");
    }

    private static String[] upOnFreePorts(Path data) {
        return ("up --kafka-port 0 --connect-port 0 --flink-port 0 --notify-port 0 --mqtt-port 0 --orion-port 0 "
                        + "--iot-agent-port 0 --mongo-port 0 --control-port 0 --health-port 0 --data " + data)
                .split(" ");
    }
}
