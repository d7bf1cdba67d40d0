package io.furrow.provisioner.account;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.device.FarmSecret;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MosquittoFilesTest {
    @TempDir
    Path directory;

    private final MqttAccount device = MqttAccount.device(SECRET, "hoeing", "d");
    private final MqttAccount gateway = MqttAccount.gateway(SECRET, "hoeing");

    @Test
    void writesAPasswordAndRulesForEachAccount() throws IOException {
        files(null).replace(List.of(gateway, device), Set.of());

        String key = SECRET.apiKey("hoeing");
        assertThat(Files.readAllLines(rules()))
                .contains(
                        "user furrow.m.hoeing.1",
                        "topic write /%s/+/attrs".formatted(key),
                        "topic read /json/%s/+/cmd".formatted(key))
                .contains("user furrow.d.hoeing.d.1.0", "topic write /%s/d/cmdexe".formatted(key));
        List<String> lines = Files.readAllLines(passwords());
        assertThat(lines).anyMatch(line -> MosquittoPassword.isOf(line, device.login()));
        assertThat(lines).noneMatch(line -> line.contains(device.login().password()));
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(passwords())))
                .isEqualTo("rw-r-----");
    }

    @Test
    void retainsForeignUsersAndPermissions() throws IOException {
        Files.write(passwords(), List.of("agent:$7$101$c2FsdA==$aGFzaA=="));
        Files.setPosixFilePermissions(passwords(), PosixFilePermissions.fromString("rw-r--r--"));
        files(null).replace(List.of(gateway, device), Set.of());
        Files.writeString(passwords(), Files.readString(passwords()) + "late:$7$101$c2FsdA==$aGFzaA==\n");

        files(null).replace(List.of(gateway), Set.of());

        assertThat(Files.readAllLines(passwords()))
                .hasSize(5)
                .startsWith("agent:$7$101$c2FsdA==$aGFzaA==")
                .endsWith("late:$7$101$c2FsdA==$aGFzaA==");
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(passwords())))
                .isEqualTo("rw-r--r--");
    }

    @Test
    void writesTheTargetOfASymbolicLink() throws IOException {
        Path real = Files.createFile(passwords().resolveSibling("real"));
        Files.setPosixFilePermissions(real, PosixFilePermissions.fromString("rw-r--r--"));
        Files.createSymbolicLink(passwords(), real);

        files(null).replace(List.of(gateway), Set.of());

        assertThat(passwords()).isSymbolicLink();
        assertThat(Files.readAllLines(real)).anyMatch(line -> MosquittoPassword.isOf(line, gateway.login()));
        assertThat(PosixFilePermissions.toString(Files.getPosixFilePermissions(real)))
                .isEqualTo("rw-r--r--");
    }

    @Test
    void neitherWritesNorReloadsWithoutChanges() throws IOException {
        MosquittoFiles files = files(count());
        files.replace(List.of(gateway, device), Set.of());
        byte[] before = Files.readAllBytes(passwords());
        assertThat(calls()).isEqualTo(1);

        files.replace(List.of(gateway, device), Set.of());
        assertThat(Files.readAllBytes(passwords())).isEqualTo(before);
        assertThat(calls()).isEqualTo(1);

        files.replace(List.of(device), Set.of());
        assertThat(calls()).isEqualTo(2);
    }

    /** A rotation removes an account and adds one: Mosquitto would lose the second signal, and reject the new password. */
    @Test
    void waitsASecondBetweenReloads() throws IOException {
        MosquittoFiles files = files(count());
        files.replace(List.of(gateway, device), Set.of());
        FileTime first = Files.getLastModifiedTime(directory.resolve("calls"));

        files.retain(Set.of(device.login().user()), (user, login) -> true);

        assertThat(calls()).isEqualTo(2);
        assertThat(Files.getLastModifiedTime(directory.resolve("calls")).toInstant())
                .isAfterOrEqualTo(first.toInstant().plusSeconds(1));
    }

    @Test
    void reloadsOnceAfterAStart() throws IOException {
        files(null).replace(List.of(device), Set.of());
        byte[] before = Files.readAllBytes(passwords());
        MosquittoFiles started = files(count());

        started.retain(Set.of(device.login().user()), (user, login) -> true);
        started.retain(Set.of(device.login().user()), (user, login) -> true);

        assertThat(calls()).isEqualTo(1);
        assertThat(Files.readAllBytes(passwords())).isEqualTo(before);
    }

    @Test
    void replacesAPasswordThatDoesNotMatchTheSecret() throws IOException {
        files(null).replace(List.of(device), Set.of());
        Files.writeString(passwords(), Files.readString(passwords()).replaceAll("\\$7\\$101\\$.", "\\$7\\$101\\$!"));

        files(null).replace(List.of(device), Set.of());

        assertThat(Files.readAllLines(passwords())).anyMatch(line -> MosquittoPassword.isOf(line, device.login()));
    }

    @Test
    void runsTheCommandAgainUntilItSucceeds() throws IOException {
        Path ready = directory.resolve("ready");
        MosquittoFiles files = files("PASSWORD=of-an-administrator; echo not yet; test -e " + ready);

        assertThatThrownBy(() -> files.replace(List.of(device), Set.of()))
                .isInstanceOf(IOException.class)
                .hasMessage("the command of --mqtt-reload ended with 1: not yet");
        assertThatThrownBy(() -> files.replace(List.of(device), Set.of())).isInstanceOf(IOException.class);
        Files.createFile(ready);
        files.replace(List.of(device), Set.of());
        Files.delete(ready);
        files.replace(List.of(device), Set.of());
    }

    @Test
    void doesNotBlockOnTheOutputOfTheCommand() throws IOException {
        files("yes | head -c 200000").replace(List.of(device), Set.of());
        assertThatThrownBy(() -> files("yes | head -c 200000; exit 3").replace(List.of(device), Set.of()))
                .hasMessageStartingWith("the command of --mqtt-reload ended with 3: y");
    }

    @Test
    void rejectsAUserOutsideOfItsSection() throws IOException {
        String user = device.login().user();
        Files.write(passwords(), List.of(MosquittoPassword.line(new FarmSecret.Login(user, "plough"))));
        Files.write(rules(), List.of("  user   " + gateway.login().user(), "topic readwrite #"));
        List<String> before = Files.readAllLines(passwords());

        Map<String, String> rejected = files(null).replace(List.of(gateway, device, other()), Set.of());

        assertThat(rejected).containsOnlyKeys(user, gateway.login().user());
        assertThat(rejected.get(user))
                .contains("'" + user + "' exists outside of Furrow's section of " + passwords(), "remove it there");
        assertThat(Files.readAllLines(passwords()))
                .startsWith(before.get(0))
                .filteredOn(line -> line.contains(":$7$"))
                .hasSize(2);
        assertThat(Files.readAllLines(rules()))
                .contains("user " + other().login().user());

        Files.write(passwords(), List.of());
        Files.write(rules(), List.of());
        assertThat(files(null).replace(List.of(gateway, device, other()), Set.of()))
                .isEmpty();
    }

    @Test
    void removesPasswordsAndRulesOfOtherUsers() throws IOException {
        Files.write(passwords(), List.of("agent:$7$101$c2FsdA==$aGFzaA=="));
        Files.write(rules(), List.of("user agent", "topic readwrite #"));
        MosquittoFiles files = files(count());
        files.replace(List.of(gateway, device, other()), Set.of());

        files.retain(Set.of(device.login().user(), "somebody"), (user, login) -> true);

        assertThat(Files.readAllLines(passwords()))
                .filteredOn(line -> line.contains(":$7$"))
                .extracting(MosquittoPassword::user)
                .containsExactly("agent", device.login().user());
        assertThat(Files.readAllLines(rules()))
                .filteredOn(line -> line.startsWith("user "))
                .containsExactly("user agent", "user " + device.login().user());
        assertThat(Files.readAllLines(rules()))
                .filteredOn(line -> line.startsWith("topic"))
                .hasSize(7);
        assertThat(calls()).isEqualTo(2);

        files.retain(Set.of(device.login().user()), (user, login) -> true);
        assertThat(calls()).isEqualTo(2);
    }

    private static MqttAccount other() {
        return MqttAccount.device(SECRET, "weeding", "d");
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
