package io.furrow.launcher;

import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;

import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

/** What bash proposes, with a furrow that knows some names. */
class CompletionTest {
    @TempDir
    static Path directory;

    @BeforeAll
    static void generate() throws Exception {
        try (PrintWriter out = new PrintWriter(directory.resolve("furrow.bash").toFile())) {
            assertThat(Furrow.commandLine().setOut(out).execute("generate-completion"))
                    .isZero();
        }
        Path furrow = Files.writeString(directory.resolve("furrow"), """
                #!/bin/sh
                case "$*" in
                    "mission list -o name") printf 'weeding\\nwalking\\nharrowing\\n' ;;
                    "device list -o name") printf 'urn:ngsi-ld:Thermometer:1\\nurn:ngsi-ld:Thermometer:2\\nurn:ngsi-ld:Robot:1\\n' ;;
                    "replay missions -o name") echo weeded ;;
                    "replay list -o name") echo weeding.0a1b2c3d ;;
                    *) echo "furrow $*" >&2; exit 1 ;;
                esac
                """);
        Files.setPosixFilePermissions(furrow, PosixFilePermissions.fromString("rwxr-xr-x"));
    }

    /** The words are those into which bash divides the line, with its usual COMP_WORDBREAKS. */
    @ParameterizedTest
    @CsvSource({
        "'furrow mission show w', 'weeding walking'",
        "'furrow mission stop weeding ha', harrowing",
        "'furrow mission stop --wait ', 'weeding walking harrowing'",
        "'furrow device list --mission we', weeding",
        "'furrow device show urn:ngsi-ld:Th', 'Thermometer:1 Thermometer:2'",
        "'furrow device show u', 'urn:ngsi-ld:Thermometer:1 urn:ngsi-ld:Thermometer:2 urn:ngsi-ld:Robot:1'",
        "'furrow replay start w', weeded",
        "'furrow replay pause w', weeding.0a1b2c3d",
        "'furrow mission sho', show",
        "'furrow ben', bench",
        "'furrow mission list --out', --output",
        "'furrow mission list --output j', 'json jsonpath='",
        "'furrow mission list --output y', yaml",
        "'furrow alarm show x', ''"
    })
    void completesNames(String line, String replies) throws Exception {
        String script = """
                source furrow.bash
                COMP_WORDBREAKS=$' \\t\\n"\\'><=;|&(:'
                COMP_LINE=$1 COMP_POINT=${#1}
                COMP_WORDS=(${1//:/ : })
                [[ $1 != *' ' ]] || COMP_WORDS+=("")
                COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
                _complete_furrow_names furrow "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}" 2>/dev/null
                echo "${COMPREPLY[@]}"
                """;
        ProcessBuilder bash = new ProcessBuilder("bash", "-c", script, "bash", line);
        bash.environment().merge("PATH", directory.toString(), (path, first) -> first + ":" + path);

        assertThat(TestProcess.run(bash.directory(directory.toFile())))
                .isEqualTo(new TestProcess.Ended(0, replies + "\n"));
    }
}
