package io.furrow.ingest.image;

import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.flink.job.JobCommandLine;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ImageOptionsTest {
    @Command(name = "job")
    private static final class Job {
        @Mixin
        private ImageOptions images;
    }

    @Test
    void leavesImagesInTheEventsUnlessToldWhereToPutThem() {
        assertThat(parsed().settings(StorageMode.ALL)).isEmpty();
    }

    @ParameterizedTest
    @CsvSource({
        "hdfs://namenode:8020/images/, hdfs://namenode:8020/images", "s3://bucket, s3://bucket",
        "s3://bucket/a/b, s3://bucket/a/b", "file:///data/images///, file:///data/images",
        "/data/images, file:///data/images", "/, file:///"
    })
    void takesAFolderOnAnyFileSystem(String given, String root) {
        assertThat(parsed("--images", given)
                        .settings(StorageMode.ALL)
                        .orElseThrow()
                        .root())
                .isEqualTo(root);
    }

    @Test
    void takesARelativeFolderFromWhereItRuns() {
        assertThat(parsed("--images", "images")
                        .settings(StorageMode.ALL)
                        .orElseThrow()
                        .root())
                .isEqualTo("file://" + Path.of("images").toAbsolutePath());
    }

    @ParameterizedTest
    @ValueSource(strings = {"/data dir/images", "/Höfe/a#b", "/100%/x", "/what?", "/a:b/c"})
    void takesAPathOfAnyCharacters(String given) {
        assertThat(parsed("--images", given)
                        .settings(StorageMode.ALL)
                        .orElseThrow()
                        .root())
                .isEqualTo(Path.of(given).toUri().toString());
    }

    @Test
    void takesSeveralAttributes() {
        assertThat(parsed("--images", "/x")
                        .settings(StorageMode.ALL)
                        .orElseThrow()
                        .attributes())
                .containsExactly("Image");
        assertThat(parsed("--images", "/x", "--image-attribute", "Left,Right")
                        .settings(StorageMode.ALL)
                        .orElseThrow()
                        .attributes())
                .containsExactly("Left", "Right");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    --images=s3://bucket/a b                  | is not a URI
                    --images=s3://bucket/a?x=1                | is not a folder
                    --images=mailto:a@b                       | is not a folder
                    --images=/x --image-max-bytes=0           | --image-max-bytes 0 lets no image pass
                    --images=/x --image-threads=0             | --image-threads 0 writes nothing
                    --images=/x --image-in-flight=0           | --image-in-flight 0 lets nothing pass
                    --images=/x --image-attribute=Left,,Right | --image-attribute has an empty name
                    """)
    void refusesAWrongSettingWithARemedy(String args, String message) {
        ImageOptions options = parsed(args.split(" (?=--)"));

        assertThatThrownBy(() -> options.settings(StorageMode.ALL))
                .isInstanceOf(CommandLine.ParameterException.class)
                .hasMessageContainingAll(message, ";");
    }

    private static ImageOptions parsed(String... args) {
        Job job = new Job();
        JobCommandLine.of(job).parseArgs(args);
        return job.images;
    }
}
