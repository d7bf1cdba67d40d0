package io.furrow.mission.image;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class ImageUsageTest {
    private static final long TIME = 1_700_000_000_123L;

    @TempDir
    Path folder;

    @Test
    void addsTheImagesOfAMissionOverTenantsAndServicePaths() throws Exception {
        for (FiwareScope scope :
                List.of(FiwareScope.DEFAULT, new FiwareScope("farm", "/"), new FiwareScope("farm", "/north"))) {
            write(ImageName.of(scope, "north", "weeding", "c", TIME));
        }
        write(ImageName.of(new FiwareScope("farm", "/"), "north", "", "c", TIME));

        assertThat(ImageUsage.of(new org.apache.flink.core.fs.Path("file://" + folder)))
                .containsExactlyInAnyOrder(
                        new ImageUsage("north", "weeding", 3, 3, 30), new ImageUsage("north", "", 1, 1, 10));
    }

    private void write(ImageName name) throws Exception {
        Path file = folder.resolve(name.path("png"));
        Files.createDirectories(file.getParent());
        Files.write(file, new byte[10]);
    }
}
