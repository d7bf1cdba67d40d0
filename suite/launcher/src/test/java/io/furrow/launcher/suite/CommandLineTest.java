package io.furrow.launcher.suite;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;

import static org.assertj.core.api.Assertions.assertThat;

class CommandLineTest extends CommandLineFixture {
    @ParameterizedTest
    @CsvSource({
        "--help, demo",
        "help mission, watch",
        "--version, furrow",
        "init --help, FOLDER",
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
}
