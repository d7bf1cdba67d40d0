package io.furrow.distribution;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

/** The Debian package, by dpkg itself, in a folder instead of {@code /}. */
class DebianPackageIT {
    private static final String VERSION = System.getProperty("furrow.version");

    @TempDir
    private Path root;

    @Test
    void installsAndRemovesAndLeavesWhatAFarmHasStored() throws Exception {
        for (String folder : List.of("var/lib/dpkg/updates", "var/lib/dpkg/info", "var/lib/dpkg/triggers", "etc")) {
            Files.createDirectories(root.resolve(folder));
        }
        for (String file : List.of("var/lib/dpkg/status", "etc/passwd", "etc/group", "etc/shadow", "etc/gshadow")) {
            Files.createFile(root.resolve(file));
        }

        dpkg("--install", Path.of("target", "furrow-%s.deb".formatted(VERSION)).toString());

        assertThat(run(root.resolve("opt/furrow/bin/furrow").toString(), "--version"))
                .isEqualTo("furrow %s\n".formatted(VERSION));
        assertThat(root.resolve("usr/lib/systemd/system/furrow.service"))
                .content()
                .contains("User=furrow");
        assertThat(Files.readSymbolicLink(root.resolve("usr/bin/furrow"))).isEqualTo(Path.of("/opt/furrow/bin/furrow"));
        assertThat(Files.readSymbolicLink(root.resolve("usr/share/bash-completion/completions/furrow")))
                .isEqualTo(Path.of("/opt/furrow/completions/furrow.bash"));
        assertThat(Files.readString(root.resolve("etc/passwd")))
                .startsWith("furrow:x:")
                .contains("/var/lib/furrow:");

        Path stored = Files.createDirectories(root.resolve("var/lib/furrow")).resolve("farm-secret");
        Files.writeString(stored, "secret");
        dpkg("--remove", "furrow");
        assertThat(root.resolve("opt/furrow")).doesNotExist();
        assertThat(root.resolve("usr/bin/furrow")).doesNotExist();
        dpkg("--purge", "furrow");
        assertThat(stored).hasContent("secret");
    }

    /** Without a look at what it depends on: there is no other package in the folder. */
    private void dpkg(String... words) throws Exception {
        run(Stream.concat(
                        Stream.of(
                                "dpkg",
                                "--root=" + root,
                                "--force-script-chrootless",
                                "--force-depends",
                                "--force-not-root",
                                "--log=/dev/null"),
                        Stream.of(words))
                .toArray(String[]::new));
    }

    private String run(String... words) throws IOException, InterruptedException {
        ProcessBuilder builder = new ProcessBuilder(words);
        builder.environment().put("JAVA_HOME", System.getProperty("java.home"));
        TestProcess.Ended ended = TestProcess.run(builder);
        assertThat(ended.status()).as(ended.output()).isZero();
        return ended.output();
    }
}
