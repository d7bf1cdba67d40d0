package io.furrow.model.device;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FarmSecretCodecTest {
    private static final Instant NOW = Instant.parse("2026-03-01T08:00:00Z");

    @TempDir
    Path folder;

    @Test
    void readsAFileOfOneLine() throws IOException {
        assertThat(FarmSecret.read(file("0123456789abcdef\n")))
                .isEqualTo(new FarmSecret("0123456789abcdef".getBytes(UTF_8)));
    }

    @Test
    void readsBackAFile() throws IOException {
        FarmSecret words = FarmSecret.read(file("a secret of words, \"0123\" ü\n"));
        FarmSecret rotated = words.rotated(NOW, NOW.plusSeconds(60), false);
        FarmSecret twice = rotated.rotated(NOW, NOW.plusSeconds(90), true);

        for (FarmSecret each : new FarmSecret[] {words, rotated, twice, FarmSecret.generate()}) {
            assertThat(FarmSecret.read(file(FarmSecretCodec.write(each)))).isEqualTo(each);
        }
    }

    @Test
    void ignoresCommentsAndEmptyLines() throws IOException {
        FarmSecret secret = FarmSecret.read(file("""
                farm-secret 1
                # the new one

                key 2 fedcba9876543210
                key 1 0123456789abcdef api-keys until 2026-04-01T08:00:00Z
                """));

        assertThat(secret.newestKey()).isEqualTo(2);
        assertThat(secret.apiKey("a")).isEqualTo(new FarmSecret("0123456789abcdef".getBytes(UTF_8)).apiKey("a"));
    }

    /** An older version reads the first line as the secret and must reject it as too short. */
    @Test
    void beginsWithALineTooShortForASecret() {
        assertThat(FarmSecretCodec.HEADER.length()).isLessThan(FarmKey.MIN_BYTES);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    short                                                                  | at least 16 bytes, this one 5
                    farm-secret 2                                                          | is the form of a newer Furrow
                    farm-secret 1                                                          | 0 lines have 'api-keys'
                    farm-secret 1;key 1 0123456789abcdef                                   | 0 lines have 'api-keys'
                    farm-secret 1;key 1 plough api-keys                                    | line 2: a farm's secret has at least 16 bytes, this one 6
                    farm-secret 1;;key one 0123456789abcdef                                | line 3: a line is 'key <number> <key>'
                    farm-secret 1;key 1 0123456789abcdef api-keys until soon               | line 2: 'soon' is not a time such as 2026-03-01T08:00:00Z
                    farm-secret 1;key 1 0123456789abcdef api-keys;key 1 fedcba9876543210   | two keys have one number
                    farm-secret 1;key 1 0123456789abcdef api-keys;key 2 fedcba9876543210   | key 1 has no 'until'
                    farm-secret 1;key 1 0123456789abcdef api-keys until 2026-04-01T08:00:00Z | key 1 is the newest and has 'until'
                    """)
    void namesTheFileAndTheProblem(String lines, String message) throws IOException {
        Path file = file(lines.replace(';', '\n'));

        assertThatThrownBy(() -> FarmSecret.read(file))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll(file.toString(), message);
    }

    @Test
    void saysHowToCreateAMissingFile() {
        Path missing = folder.resolve("missing");

        assertThatThrownBy(() -> FarmSecret.read(missing))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("there is no file " + missing, "./furrow secret new");
    }

    private Path file(String text) throws IOException {
        return Files.writeString(folder.resolve("secret"), text);
    }
}
