package io.furrow.control.provisioning;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MosquittoFilesTest {
    @TempDir
    Path directory;

    private final MqttAccount device = MqttAccount.device(Wanted.SECRET, "hoeing", "d");
    private final MqttAccount gateway = MqttAccount.gateway(Wanted.SECRET, "hoeing");

    @Test
    void writesAPasswordAndRulesForEachAccount() throws IOException {
        files(null).replace(List.of(gateway, device));

        String key = Wanted.SECRET.apiKey("hoeing");
        assertThat(Files.readAllLines(rules()))
                .contains(
                        "user hoeing",
                        "topic write /%s/+/attrs".formatted(key),
                        "topic read /json/%s/+/cmd".formatted(key))
                .contains("user hoeing.d", "topic write /%s/d/cmdexe".formatted(key));
        List<String> lines = Files.readAllLines(passwords());
        assertThat(lines).anyMatch(line -> MosquittoPassword.isOf(line, device.login()));
        assertThat(lines).noneMatch(line -> line.contains(device.login().password()));
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(passwords())))
                .isEqualTo("rw-r-----");
    }

    @Test
    void leavesUsersOfOthersAndThePermissionsAsTheyAre() throws IOException {
        Files.write(passwords(), List.of("agent:$7$101$c2FsdA==$aGFzaA=="));
        Files.setPosixFilePermissions(passwords(), PosixFilePermissions.fromString("rw-r--r--"));
        files(null).replace(List.of(gateway, device));
        Files.writeString(passwords(), Files.readString(passwords()) + "late:$7$101$c2FsdA==$aGFzaA==\n");

        files(null).replace(List.of(gateway));

        assertThat(Files.readAllLines(passwords()))
                .hasSize(5)
                .startsWith("agent:$7$101$c2FsdA==$aGFzaA==")
                .endsWith("late:$7$101$c2FsdA==$aGFzaA==");
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(passwords())))
                .isEqualTo("rw-r--r--");
    }

    @Test
    void touchesNothingAndTellsNobodyWhereNothingChanges() throws IOException {
        files(count()).replace(List.of(gateway, device));
        byte[] before = Files.readAllBytes(passwords());
        assertThat(calls()).isEqualTo(1);

        files(count()).replace(List.of(gateway, device));
        assertThat(Files.readAllBytes(passwords())).isEqualTo(before);
        assertThat(calls()).isEqualTo(1);

        files(count()).replace(List.of(device));
        assertThat(calls()).isEqualTo(2);
    }

    @Test
    void makesAPasswordAnewThatIsNotOfTheSecret() throws IOException {
        files(null).replace(List.of(device));
        Files.writeString(passwords(), Files.readString(passwords()).replaceAll("\\$7\\$101\\$.", "\\$7\\$101\\$!"));

        files(null).replace(List.of(device));

        assertThat(Files.readAllLines(passwords())).anyMatch(line -> MosquittoPassword.isOf(line, device.login()));
    }

    @Test
    void runsTheCommandAgainUntilItSucceeds() throws IOException {
        Path ready = directory.resolve("ready");
        MosquittoFiles files = files("echo not yet; test -e " + ready);

        assertThatThrownBy(() -> files.replace(List.of(device)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("ended with 1: not yet");
        assertThatThrownBy(() -> files.replace(List.of(device))).isInstanceOf(IOException.class);
        Files.createFile(ready);
        files.replace(List.of(device));
        Files.delete(ready);
        files.replace(List.of(device));
    }

    private MosquittoFiles files(String reload) {
        return new MosquittoFiles(passwords(), rules(), reload);
    }

    private Path passwords() {
        return directory.resolve("passwords");
    }

    private Path rules() {
        return directory.resolve("rules");
    }

    private String count() {
        return "echo >> " + directory.resolve("calls");
    }

    private long calls() throws IOException {
        return Files.readAllLines(directory.resolve("calls")).size();
    }
}
