package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

/** Options of servers that cannot be right. */
class RejectedOptionsTest extends CommandLineFixture {
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
        assertThat(refusal(with(upOnFreePorts(directory), options.split(" ")))).startsWith(sentence);
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
}
