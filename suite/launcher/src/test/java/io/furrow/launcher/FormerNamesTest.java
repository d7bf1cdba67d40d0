package io.furrow.launcher;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import static org.assertj.core.api.Assertions.assertThat;

/** An option has the same name in all commands. Former names are understood. */
class FormerNamesTest {
    private final CommandLine furrow = Furrow.commandLine();

    @ParameterizedTest
    @CsvSource({
        "dashboard, --control-plane=http://farm.lan:8085, --api, http://farm.lan:8085",
        "dashboard, --insecure, --listen-insecure, true",
        "device-host --farm-secret=x, --context-broker=http://farm.lan:1026, --orion, http://farm.lan:1026",
        "device-host --farm-secret=x, --mqtt-qos=0, --qos, 0"
    })
    void understandsAFormerName(String command, String former, String name, String value) {
        for (String option : new String[] {former, former.replaceFirst("^[^=]*", name)}) {
            CommandSpec parsed = furrow.parseArgs((command + " " + option).split(" "))
                    .subcommand()
                    .commandSpec();

            Object read = parsed.findOption(name).getValue();
            assertThat(read).as(option).hasToString(value);
        }
    }
}
