package io.furrow.launcher;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.nio.file.attribute.PosixFilePermissions;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The script {@code furrow} in a folder of its own, with a Maven and a Java that only say that they were called. */
@Tag("full")
class FirstStartIT {
    private static final Duration TIMEOUT = Duration.ofMinutes(2);
    private static final String BUILDS = """
            echo "[INFO] Building Furrow launcher 0.1.0 [1/1]"
            echo called >>"$(dirname "$0")/builds"
            """;

    @TempDir
    Path directory;

    private Path home;
    private Path bin;

    private record Ended(int status, String out, String err) {}

    @BeforeEach
    void copyTheScript() throws IOException {
        home = Files.createDirectories(directory.resolve("a folder/of furrow"));
        bin = Files.createDirectory(directory.resolve("jdk"));
        Files.createDirectories(home.resolve("suite/launcher/src"));
        Files.createDirectories(home.resolve("suite/launcher/target/furrow"));
        Files.writeString(home.resolve("pom.xml"), "<project/>");
        Files.writeString(home.resolve("suite/launcher/pom.xml"), "<project/>");
        Files.copy(Path.of("..", "..", "furrow"), home.resolve("furrow"));
        java("17");
        program(bin.resolve("javac"), "exit 0");
        program(home.resolve("mvnw"), BUILDS);
    }

    @Test
    void buildsOnceAndRunsWhatItBuilt() throws Exception {
        Ended first = furrow("demo");
        Ended second = furrow("demo");

        assertThat(first.status()).as(first.err()).isZero();
        assertThat(first.err()).contains("Building Furrow", "Built in").doesNotContain("\r");
        assertThat(first.out()).isEqualTo(second.out()).contains("io.furrow.launcher.Furrow demo");
        assertThat(second.err()).doesNotContain("Building Furrow");
        assertThat(home.resolve("builds")).hasContent("called");
    }

    @Test
    void reportsWhatMavenFoundWrong() throws Exception {
        program(
                home.resolve("mvnw"),
                "echo '[INFO] fine so far'; echo '[ERROR] Failed to execute goal: disk full'; echo '[ERROR] '; exit 1");

        Ended ended = furrow("demo");

        assertThat(ended.status()).isEqualTo(1);
        assertThat(ended.err())
                .contains("[ERROR] Failed to execute goal: disk full")
                .contains("The build failed")
                .contains(home.resolve("target/build.log").toString())
                .doesNotContain("fine so far");
    }

    @Test
    void showsTheEndOfTheLogWhereMavenNeverCameToRun() throws Exception {
        program(home.resolve("mvnw"), "echo 'wget: Failed to fetch the distribution: no route to host' >&2; exit 4");

        Ended ended = furrow("demo");

        assertThat(ended.status()).isEqualTo(1);
        assertThat(ended.err())
                .contains("wget: Failed to fetch the distribution: no route to host")
                .contains(home.resolve("target/build.log").toString());
    }

    @Test
    void reportsSoWhereThereIsNothingInTheLog() throws Exception {
        program(home.resolve("mvnw"), "exit 1");

        assertThat(furrow("demo").err()).contains("nothing", "full disk");
    }

    @Test
    void runsThroughALinkOfALink() throws Exception {
        Path links = Files.createDirectories(directory.resolve("home/bin"));
        Files.createSymbolicLink(directory.resolve("furrow-here"), home.resolve("furrow"));
        Path link = Files.createSymbolicLink(links.resolve("furrow"), Path.of("../../furrow-here"));

        Ended ended = run(link, "demo");

        assertThat(ended.status()).as(ended.err()).isZero();
        assertThat(ended.out()).contains("-Dfurrow.home=" + home.toRealPath());
    }

    @ParameterizedTest
    @ValueSource(strings = {"1.8", "11", "16"})
    void rejectsAJavaThatIsTooOld(String version) throws Exception {
        java(version);

        Ended ended = furrow("demo");

        assertThat(ended.status()).isEqualTo(1);
        assertThat(ended.err()).contains("Java " + version, "too old", "Set JAVA_HOME to a JDK 17 or 21");
        assertThat(home.resolve("builds")).doesNotExist();
    }

    @ParameterizedTest
    @ValueSource(strings = {"22", "25", "30"})
    void buildsWithNoJavaThatIsTooNewAndWarnsOfItLater(String version) throws Exception {
        java(version);
        Ended build = furrow("demo");
        java("17");
        furrow("demo");
        java(version);
        Ended run = furrow("demo");

        assertThat(build.status()).isEqualTo(1);
        assertThat(build.err()).contains("Java " + version, "cannot build", "Set JAVA_HOME to a JDK 17 or 21");
        assertThat(run.status()).isZero();
        assertThat(run.err()).contains("Java " + version + " is not supported", "hdfs://");
        assertThat(run.out()).contains("io.furrow.launcher.Furrow demo");
    }

    @ParameterizedTest
    @ValueSource(strings = {"17", "21"})
    void takesASupportedJavaInSilence(String version) throws Exception {
        java(version);

        assertThat(furrow("demo").err()).doesNotContain("Java");
        assertThat(furrow("demo").err()).isEmpty();
    }

    @Test
    void reportsThatThereIsNoJavaInJavaHome() throws Exception {
        ProcessBuilder builder = builder(home.resolve("furrow"), "only", "demo");
        builder.environment().put("JAVA_HOME", directory.resolve("nowhere").toString());

        assertThat(ended(builder.start(), "only").err()).contains("nowhere, where no Java is", "JDK 17 or 21");
    }

    @Test
    void sendsWindowsToWsl() throws Exception {
        program(bin.resolve("uname"), "echo MINGW64_NT-10.0-22631");

        Ended ended = furrow("demo");

        assertThat(ended.status()).isEqualTo(1);
        assertThat(ended.err()).contains("WSL");
    }

    @Test
    void letsASecondFirstStartWaitForTheFirst() throws Exception {
        Path go = directory.resolve("go");
        program(home.resolve("mvnw"), BUILDS + "while [ ! -e '" + go + "' ]; do sleep 0.1; done\n");
        Process first = start(home.resolve("furrow"), "one", "demo");
        await().atMost(TIMEOUT).until(() -> Files.exists(home.resolve("builds")));
        Process second = start(home.resolve("furrow"), "two", "demo");
        await().atMost(TIMEOUT)
                .until(() -> Files.readString(directory.resolve("two.err")).contains("Another start builds Furrow"));

        Files.createFile(go);

        assertThat(ended(first, "one").status()).isZero();
        Ended waited = ended(second, "two");
        assertThat(waited.status()).as(waited.err()).isZero();
        assertThat(waited.out()).contains("io.furrow.launcher.Furrow demo");
        assertThat(home.resolve("builds")).as("built once").hasContent("called");
    }

    @Test
    void waitsForNobodyWhoHasDied() throws Exception {
        Path go = directory.resolve("go");
        program(home.resolve("mvnw"), BUILDS + "while [ ! -e '" + go + "' ]; do sleep 0.1; done\n");
        Process killed = start(home.resolve("furrow"), "one", "demo");
        await().atMost(TIMEOUT).until(() -> Files.exists(home.resolve("builds")));
        List<ProcessHandle> left = killed.descendants().toList();
        killed.destroyForcibly().waitFor();
        left.forEach(ProcessHandle::destroyForcibly);
        program(home.resolve("mvnw"), BUILDS);

        Ended ended = furrow("demo");

        assertThat(ended.status()).as(ended.err()).isZero();
        assertThat(ended.err()).doesNotContain("Another start builds Furrow");
    }

    @Test
    void endsMavenAndLeavesNoLockWhenItIsStopped() throws Exception {
        Path pid = directory.resolve("pid");
        program(home.resolve("mvnw"), "echo $$ >'" + pid + "'; while :; do sleep 0.1; done");
        Process stopped = start(home.resolve("furrow"), "one", "demo");
        await().atMost(TIMEOUT)
                .until(() -> Files.exists(pid) && !Files.readString(pid).isBlank());
        long maven = Long.parseLong(Files.readString(pid).strip());

        stopped.destroy();

        assertThat(stopped.waitFor(TIMEOUT.toSeconds(), TimeUnit.SECONDS)).isTrue();
        await().atMost(TIMEOUT)
                .until(() ->
                        ProcessHandle.of(maven).filter(ProcessHandle::isAlive).isEmpty());
        program(home.resolve("mvnw"), BUILDS);
        assertThat(furrow("demo").err()).doesNotContain("Another start builds Furrow");
    }

    private Ended furrow(String... arguments) throws Exception {
        return run(home.resolve("furrow"), arguments);
    }

    private Ended run(Path script, String... arguments) throws Exception {
        return ended(start(script, "only", arguments), "only");
    }

    private Process start(Path script, String name, String... arguments) throws IOException {
        return builder(script, name, arguments).start();
    }

    private ProcessBuilder builder(Path script, String name, String... arguments) {
        List<String> command = new ArrayList<>(List.of(script.toString()));
        command.addAll(List.of(arguments));
        ProcessBuilder builder = new ProcessBuilder(command)
                .redirectOutput(directory.resolve(name + ".out").toFile())
                .redirectError(directory.resolve(name + ".err").toFile());
        builder.environment().remove("JAVA_HOME");
        builder.environment().put("PATH", bin + ":/usr/bin:/bin");
        return builder;
    }

    private Ended ended(Process process, String name) throws Exception {
        assertThat(process.waitFor(TIMEOUT.toSeconds(), TimeUnit.SECONDS))
                .as("%s ends", name)
                .isTrue();
        return new Ended(
                process.exitValue(),
                Files.readString(directory.resolve(name + ".out")),
                Files.readString(directory.resolve(name + ".err")));
    }

    private void java(String version) throws IOException {
        program(
                bin.resolve("java"),
                "case \"$*\" in *-version*) echo '    java.specification.version = " + version
                        + "' >&2 ;; *) echo \"$@\" ;; esac");
    }

    /** Older than what is built next, or it would be built again. */
    private static void program(Path file, String script) throws IOException {
        Files.deleteIfExists(file);
        Files.write(file, ("#!/bin/sh\n" + script + "\n").getBytes(UTF_8));
        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rwxr-xr-x"));
        Files.setLastModifiedTime(file, FileTime.from(Instant.now().minusSeconds(60)));
    }
}
