package io.furrow.cli.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.stream.Stream;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;

import io.furrow.files.Folders;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.mission.image.ImageName;
import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class PurgeImagesTest {
    private static final long NOW = System.currentTimeMillis();

    @TempDir
    Path folder;

    private String young;

    @BeforeEach
    void storeImages() throws Exception {
        store("old", NOW - Duration.ofDays(31).toMillis(), 1);
        store("old", NOW - Duration.ofDays(31).toMillis(), 2);
        store("both", NOW - Duration.ofDays(31).toMillis(), 3);
        young = store("both", NOW - Duration.ofDays(29).toMillis(), 4);
        write("north/notes.txt", Instant.EPOCH);
        write("north/both/m_99999999999999999.png", Instant.EPOCH);
        write("north/m/.unfinished-1", Instant.EPOCH);
        write("north/m/.unfinished-2", Instant.ofEpochMilli(NOW));
    }

    @Test
    void deletesWhatIsOldAndEmptyFoldersAndNothingElse() throws Exception {
        long bytes = 1 + 2 + 3 + 1L;
        assertThat(run("--older-than", "30d")).isEqualTo(String.format("Deleted 4 files, %d bytes; kept 4.%n", bytes));

        assertThat(everything())
                .containsExactlyInAnyOrder(
                        young, "north/notes.txt", "north/both/m_99999999999999999.png", "north/m/.unfinished-2");
        assertThat(folder.resolve("north/m/old")).doesNotExist();
        assertThat(run("--older-than", "30d")).startsWith("Deleted 0 files");
    }

    @Test
    void reportsWhatItWouldDo() throws Exception {
        List<String> before = everything();

        assertThat(run("--older-than", "30d", "--dry-run")).startsWith("Would delete 4 files");

        assertThat(everything()).isEqualTo(before);
    }

    @Test
    void rejectsAFolderThatIsNotThereAndAnAgeThatIsNone() {
        assertThat(output(folder.resolve("none").toString(), "--older-than", "30d"))
                .contains("none is not there; name the folder of --images");
        assertThat(output(folder.toString(), "--older-than", "0s")).contains("--older-than must be positive");
    }

    private String store(String entity, long time, int bytes) throws Exception {
        ImageName image = ImageName.of(FiwareScope.DEFAULT, "north", "m", entity, time);
        boolean taken = Files.exists(folder.resolve(image.path("png")));
        String name = taken ? image.path("png", "a".repeat(64)) : image.path("png");
        Files.createDirectories(folder.resolve(name).getParent());
        Files.write(folder.resolve(name), new byte[bytes]);
        return name;
    }

    private void write(String name, Instant modified) throws IOException {
        Files.createDirectories(folder.resolve(name).getParent());
        Files.writeString(folder.resolve(name), "x");
        Files.setLastModifiedTime(folder.resolve(name), FileTime.from(modified));
    }

    private String run(String... args) {
        return output(
                Stream.concat(Stream.of(folder.toString()), Stream.of(args)).toArray(String[]::new));
    }

    private static String output(String... args) {
        StringWriter output = new StringWriter();
        CommandLine line = JobCommandLine.of(new PurgeImages());
        line.setOut(new PrintWriter(output)).setErr(new PrintWriter(output));
        line.execute(args);
        return output.toString();
    }

    private List<String> everything() throws IOException {
        return Folders.walk(folder).stream()
                .filter(Files::isRegularFile)
                .map(file -> folder.relativize(file).toString())
                .toList();
    }
}
