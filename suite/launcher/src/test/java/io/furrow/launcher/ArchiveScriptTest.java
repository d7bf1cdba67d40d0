package io.furrow.launcher;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.PosixFilePermissions;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

/** The script {@code furrow} where an archive was unpacked, with a Java that only says how it was called. */
class ArchiveScriptTest {
    @TempDir
    Path directory;

    private Path home;
    private Path jdk;

    @BeforeEach
    void unpack() throws IOException {
        home = Files.createDirectories(directory.resolve("opt/furrow 0.2"));
        jdk = Files.createDirectories(directory.resolve("jdk"));
        Files.createDirectories(home.resolve("bin"));
        Files.createDirectories(home.resolve("lib"));
        Files.copy(Path.of("..", "..", "furrow"), home.resolve("furrow"));
        Files.copy(Path.of("..", "..", "furrow"), home.resolve("bin/furrow"));
        Files.writeString(home.resolve("lib/class-path"), "furrow-launcher-0.2.jar\nkafka.jar\n");
        Files.writeString(home.resolve("lib/build"), "abc");
        Files.writeString(home.resolve("lib/furrow-launcher-0.1.jar"), "of the release that was here before");
        Files.createDirectories(jdk.resolve("bin"));
        Files.writeString(jdk.resolve("release"), "IMPLEMENTOR=\"x\"\nJAVA_VERSION=\"17.0.15\"\n");
        program(jdk.resolve("bin/java"), """
                echo "$*" >>"$(dirname "$0")/calls"
                echo "${COLUMNS-none}" >"$(dirname "$0")/columns"
                for word; do case $word in
                    -XX:ArchiveClassesAtExit=*) echo x >"${word#*=}" ;;
                    -XX:SharedArchiveFile=*) case $* in *-Xshare:dump*) echo x >"${word#*=}" ;; esac ;;
                esac; done
                """);
    }

    @ParameterizedTest
    @ValueSource(strings = {"furrow", "bin/furrow"})
    void runsTheJarsOfItsOwnReleaseWithoutABuild(String script) throws Exception {
        assertThat(run(script, "demo", "--data", "x")).isEmpty();

        assertThat(calls().get(calls().size() - 1))
                .endsWith(
                        "-Dfurrow.home=%1$s -Dfurrow.plugins=%1$s/plugins -cp %1$s/lib/furrow-launcher-0.2.jar:%1$s/lib/kafka.jar "
                                        .formatted(home)
                                + "io.furrow.launcher.Furrow demo --data x");
    }

    @Test
    void storesClassesOnceForTheseJars() throws Exception {
        Files.writeString(home.resolve("lib/classes-former.jsa"), "x");

        run("bin/furrow", "mission", "list");
        run("bin/furrow", "mission", "list");

        Path classes = home.resolve("lib/classes-abc.jsa");
        assertThat(calls())
                .hasSize(4)
                .filteredOn(call -> call.contains("-Xshare:dump"))
                .hasSize(1);
        assertThat(calls().get(3)).contains("-XX:SharedArchiveFile=" + classes + " ");
        assertThat(home.resolve("lib"))
                .isDirectoryNotContaining("glob:**former*")
                .isDirectoryContaining(classes::equals);
    }

    /** The Java of this test does not say which file is whole: it takes any. */
    @Test
    void storesTheClassesOfTheSuiteAtTheEndOfTheFirstDemonstration() throws Exception {
        Path classes = home.resolve("lib/classes-suite.jsa");

        run("bin/furrow", "up");
        run("bin/furrow", "demo");
        assertThat(calls()).last().asString().contains("-XX:ArchiveClassesAtExit=" + classes + ".new ");
        run("bin/furrow", "mission", "list");
        assertThat(calls()).last().asString().doesNotContain("classes-suite");
        run("bin/furrow", "up");
        assertThat(calls()).last().asString().contains("-XX:SharedArchiveFile=" + classes + " ");
        run("bin/furrow", "demo");

        assertThat(calls()).last().asString().contains("-XX:SharedArchiveFile=" + classes + " ");
        assertThat(calls())
                .filteredOn(call -> call.contains("ArchiveClassesAtExit=" + classes))
                .hasSize(1);
        assertThat(home.resolve("lib")).isDirectoryNotContaining("glob:**.new");
    }

    @Test
    void reportsItsVersionByOneSmallProgram() throws Exception {
        run("bin/furrow", "--version");

        assertThat(calls())
                .singleElement()
                .asString()
                .endsWith("-cp " + home.resolve("lib/furrow-launcher-0.2.jar") + " io.furrow.launcher.Version");
    }

    @ParameterizedTest
    @ValueSource(strings = {"soak collision-cases", "bench dashboard"})
    void sendsToACheckoutForWhatIsNotInIt(String arguments) throws Exception {
        assertThat(run("bin/furrow", arguments.split(" "))).contains("run", "in a checkout of Furrow");
        assertThat(jdk.resolve("bin/calls")).doesNotExist();
    }

    /** In a pipe, too, a shell may have a number of columns that is that of its terminal. */
    @Test
    void tellsJavaTheColumnsOfItsTerminalOnly() throws Exception {
        run("bin/furrow", "mission", "list");
        assertThat(jdk.resolve("bin/columns")).hasContent("none");

        program(
                directory.resolve("at-a-terminal"),
                "stty cols 77\nexec '%s' mission list\n".formatted(home.resolve("furrow")));
        run(new ProcessBuilder(
                "script", "-qec", directory.resolve("at-a-terminal").toString(), "/dev/null"));
        assertThat(jdk.resolve("bin/columns")).hasContent("77");
    }

    @Test
    void namesTheVariableThatLeadsToNoJava() throws Exception {
        jdk = directory.resolve("nowhere");

        assertThat(run("furrow", "mission", "list"))
                .startsWith("JAVA_HOME is %s, where no Java is.".formatted(jdk))
                .hasLineCount(1);
    }

    /** What it wrote to the terminal. */
    private String run(String script, String... arguments) throws Exception {
        List<String> command = new ArrayList<>(List.of(home.resolve(script).toString()));
        command.addAll(List.of(arguments));
        return run(new ProcessBuilder(command));
    }

    private String run(ProcessBuilder builder) throws Exception {
        builder.environment().put("COLUMNS", "50");
        builder.environment().put("JAVA_HOME", jdk.toString());
        builder.environment().remove("FURROW_OPTS");
        builder.environment().remove("HADOOP_CLASSPATH");
        return TestProcess.run(builder).output();
    }

    private List<String> calls() throws IOException {
        return Files.readAllLines(jdk.resolve("bin/calls"));
    }

    private static void program(Path file, String script) throws IOException {
        Files.writeString(file, "#!/bin/sh\n" + script);
        Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rwxr-xr-x"));
    }
}
