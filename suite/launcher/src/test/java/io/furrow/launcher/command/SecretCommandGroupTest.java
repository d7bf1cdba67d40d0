package io.furrow.launcher.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

import io.furrow.cli.time.Times;
import io.furrow.launcher.Furrow;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class SecretCommandGroupTest {
    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();
    private final CommandLine furrow =
            Furrow.commandLine().setOut(new PrintWriter(out, true)).setErr(new PrintWriter(err, true));

    @TempDir
    Path directory;

    private Path file;

    @BeforeEach
    void make() throws Exception {
        file = directory.resolve("secret");
        assertThat(secret("new")).isZero();
        assertThat(out.toString()).contains(FarmSecret.read(file).fingerprint());
        out.getBuffer().setLength(0);
    }

    @Test
    void makesAFileForItsOwnerAndOverwritesNone() throws Exception {
        String text = Files.readString(file);
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(file)))
                .isEqualTo("rw-------");

        assertThat(secret("new")).isNotZero();

        assertThat(err.toString()).contains(file + " is there already").hasLineCount(1);
        assertThat(file).hasContent(text);
    }

    @Test
    void rotatesKeepingTheOldPasswordsForAMonth() throws Exception {
        FarmSecret before = FarmSecret.read(file);

        assertThat(secret("rotate")).isZero();

        FarmSecret after = FarmSecret.read(file);
        assertThat(after.newestKey()).isEqualTo(2);
        assertThat(after.apiKey("m")).isEqualTo(before.apiKey("m"));
        Instant month = Instant.now().plus(Duration.ofDays(30));
        assertThat(after.at(month.minusSeconds(60)).devices("m", "d", 0))
                .containsExactly(after.device("m", "d"), before.device("m", "d"));
        assertThat(after.at(month).devices("m", "d", 0)).containsExactly(after.device("m", "d"));
        assertThat(out.toString()).contains("key 2", after.fingerprint(), "Passwords of key 1 are accepted until");
    }

    @Test
    void takesADurationAsItsHelpWritesIt() throws Exception {
        assertThat(furrow.execute("secret", "rotate", "--help")).isZero();
        Matcher example = Pattern.compile("such as\\s+(\\S+) or").matcher(out.toString());
        assertThat(example.find()).isTrue();

        assertThat(secret("rotate", "--keep-old", example.group(1))).isZero();
    }

    @Test
    void rejectsTheOldPasswordsAtOnceWhereThatIsRequested() throws Exception {
        assertThat(secret("rotate", "--keep-old", "0s")).isZero();

        FarmSecret after = FarmSecret.read(file);
        assertThat(after.at(Instant.now()).devices("m", "d", 0)).containsExactly(after.device("m", "d"));
        assertThat(out.toString()).contains("Passwords of key 1 are refused from now on");
    }

    @Test
    void makesNewApiKeysOnlyWhereThatIsRequested() throws Exception {
        FarmSecret before = FarmSecret.read(file);

        assertThat(secret("rotate", "--api-keys")).isZero();
        assertThat(FarmSecret.read(file).apiKey("m")).isNotEqualTo(before.apiKey("m"));

        assertThat(secret("rotate", "--api-keys", "--keep-old", "1d")).isNotZero();
        assertThat(err.toString()).contains("leave --keep-old out");
    }

    @Test
    void showsWhatMayBeShown() throws Exception {
        secret("rotate");
        out.getBuffer().setLength(0);

        assertThat(secret("show")).isZero();

        List<FarmSecret.KeyInfo> keys = FarmSecret.read(file).describe();
        assertThat(out.toString().lines())
                .containsExactly(
                        "key 2  %s  makes passwords".formatted(keys.get(0).fingerprint()),
                        "key 1  %s  its passwords are accepted until %s, makes API keys"
                                .formatted(
                                        keys.get(1).fingerprint(),
                                        Times.of(keys.get(1).until().toEpochMilli())));
        out.getBuffer().setLength(0);

        assertThat(secret("show", "-o", "json")).isZero();

        assertThat(NgsiJson.read(out.toString().getBytes(UTF_8))).isEqualTo(NgsiJson.read("""
                        [{"key": 2, "fingerprint": "%s", "makesPasswords": true, "makesApiKeys": false},
                         {"key": 1, "fingerprint": "%s", "makesPasswords": false, "makesApiKeys": true, "acceptedUntil": "%s"}]""".formatted(
                        keys.get(0).fingerprint(),
                        keys.get(1).fingerprint(),
                        keys.get(1).until())
                .getBytes(UTF_8)));
    }

    @Test
    void reportsWhatToDoWhereThereIsNoFile() {
        file = directory.resolve("missing");

        assertThat(secret("rotate")).isNotZero();

        assertThat(err.toString())
                .contains("there is no file " + file, "./furrow secret new")
                .hasLineCount(1);
    }

    private int secret(String command, String... options) {
        List<String> arguments = new ArrayList<>(List.of("secret", command, file.toString()));
        arguments.addAll(List.of(options));
        return furrow.execute(arguments.toArray(String[]::new));
    }
}
