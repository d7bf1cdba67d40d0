package io.furrow.ingest.image;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;

import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.LimitedConnectionsFileSystem;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.files.Folders;
import io.furrow.mission.image.ImageName;
import io.furrow.model.event.FiwareScope;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ImageFilesTest {
    private static final ImageName NAME =
            ImageName.of(FiwareScope.DEFAULT, "north", "weeding", "urn:Camera:1", Pictures.TIME);
    private static final String FIRST = "north/weeding/urn~3ACamera~3A1/urn~3ACamera~3A1_20231114221320123.png";

    @TempDir
    Path folder;

    @Test
    void writesAnImageAndSaysWhereItIs() throws Exception {
        Image image = image(Pictures.png(1));

        StoredImage stored = files().store(NAME, image);

        assertThat(stored)
                .isEqualTo(new StoredImage(
                        "file://" + folder + "/" + FIRST, image.sha256(), image.bytes().length, "image/png"));
        assertThat(folder.resolve(FIRST)).hasBinaryContent(Pictures.png(1));
        assertThat(everything()).containsExactly(FIRST);
    }

    @Test
    void writesBelowAFolderWhoseNameAUrlCannotHave() throws Exception {
        Path root = folder.resolve("Höfe #1, 100% x");
        Image image = image(Pictures.png(1));

        StoredImage stored = ImageFiles.in(root.toUri().toString()).store(NAME, image);

        assertThat(Path.of(java.net.URI.create(stored.url()))).isEqualTo(root.resolve(FIRST));
        assertThat(everything()).containsExactly(root.getFileName() + "/" + FIRST);
    }

    @Test
    void writesTheSameImageOnce() throws Exception {
        files().store(NAME, image(Pictures.png(1)));
        FileTime old = FileTime.fromMillis(1_000_000);
        Files.setLastModifiedTime(folder.resolve(FIRST), old);

        StoredImage again = files().store(NAME, image(Pictures.png(1)));

        assertThat(again.url()).endsWith(FIRST);
        assertThat(Files.getLastModifiedTime(folder.resolve(FIRST))).isEqualTo(old);
    }

    @Test
    void keepsBothOfTwoImagesOfOneMillisecond() throws Exception {
        for (int time = 0; time < 2; time++) { // a second pass, as after a restart, finds the same names
            StoredImage one = files().store(NAME, image(Pictures.png(1)));
            StoredImage two = files().store(NAME, image(Pictures.png(2)));

            assertThat(one.url()).endsWith(FIRST);
            assertThat(two.url()).endsWith("123-" + two.sha256() + ".png");
            assertThat(everything()).hasSize(2);
            assertThat(Path.of(java.net.URI.create(one.url()))).hasBinaryContent(Pictures.png(1));
            assertThat(Path.of(java.net.URI.create(two.url()))).hasBinaryContent(Pictures.png(2));
        }
    }

    @Test
    void endsEveryNameInTheHashWhereOthersReferToIt() throws Exception {
        Image image = image(Pictures.png(1));
        ImageStore mine = ImageStore.of(settings(StorageMode.FOR_OTHERS));
        ImageStore others = ImageStore.of(settings(StorageMode.BY_OTHERS));

        StoredImage told = others.store(NAME, image);
        assertThat(everything()).isEmpty();

        assertThat(mine.store(NAME, image)).isEqualTo(told);
        assertThat(mine.store(NAME, image)).isEqualTo(told);
        assertThat(told.url()).endsWith("123-" + image.sha256() + ".png");
        assertThat(Path.of(java.net.URI.create(told.url()))).hasBinaryContent(Pictures.png(1));
        assertThat(everything()).hasSize(1);
    }

    private ImageSettings settings(StorageMode storageMode) {
        return new ImageSettings("file://" + folder, Set.of("Image"), 100_000, 1, 1, Duration.ZERO, storageMode);
    }

    @Test
    void hasAnImageOnTheDiskBeforeItHasItsName() throws Exception {
        List<String> calls = new ArrayList<>();
        ImageFiles files = new ImageFiles("file://" + folder, new RecordingFiles(calls));

        files.store(NAME, image(Pictures.png(1)));

        assertThat(calls).containsExactly("write", "sync", "close", "rename");
        assertThat(folder.resolve(FIRST)).hasBinaryContent(Pictures.png(1));
    }

    @Test
    void hasItOnTheDiskThroughAWrapperOfFlinkAsTasksGetIt() throws Exception {
        List<String> calls = new ArrayList<>();
        FileSystem wrapped = new LimitedConnectionsFileSystem(new RecordingFiles(calls), 1);

        new ImageFiles("file://" + folder, wrapped).store(NAME, image(Pictures.png(1)));

        assertThat(calls).containsExactly("write", "sync", "close", "rename");
    }

    @Test
    void leavesADamagedFileAndWritesTheImageBesideIt() throws Exception {
        Image image = image(Pictures.png(1));
        Files.createDirectories(folder.resolve(FIRST).getParent());
        Files.write(folder.resolve(FIRST), new byte[image.bytes().length]);

        String url = files().store(NAME, image).url();
        assertThat(Path.of(java.net.URI.create(url))).hasBinaryContent(image.bytes());

        Files.write(Path.of(java.net.URI.create(url)), new byte[3]);
        assertThat(files().store(NAME, image).url()).isEqualTo(url);
        assertThat(Path.of(java.net.URI.create(url))).hasBinaryContent(image.bytes());
    }

    @Test
    void leavesNothingBehindOfAWriteThatFails() throws Exception {
        Files.writeString(folder.resolve("north"), "a file where a folder should be");

        assertThatThrownBy(() -> files().store(NAME, image(Pictures.png(1)))).isInstanceOf(IOException.class);

        assertThat(everything()).containsExactly("north");
    }

    @Test
    void refusesAKindOfUriThatFlinkHasNoFileSystemFor() {
        assertThatThrownBy(() -> ImageFiles.in("nowhere://x/y"))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("nowhere");
    }

    private ImageFiles files() throws IOException {
        return ImageFiles.in("file://" + folder);
    }

    private static Image image(byte[] bytes) throws Exception {
        return Image.of(Pictures.base64(bytes).getBytes(US_ASCII), 1_000_000);
    }

    private List<String> everything() throws IOException {
        return Folders.walk(folder).stream()
                .filter(Files::isRegularFile)
                .map(file -> folder.relativize(file).toString())
                .toList();
    }
}
