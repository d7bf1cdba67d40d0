package io.furrow.launcher.suite;

import java.nio.file.Path;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class JobFolderTest {
    @ParameterizedTest
    @ValueSource(strings = {"/data/jobs", "/data dir/jobs", "/Höfe/a#b", "/100%/%20", "/what?/x"})
    void isWhereFlinkLooksForIt(String folder) {
        org.apache.flink.core.fs.Path location = new org.apache.flink.core.fs.Path(JobFolder.location(Path.of(folder)));

        assertThat(location.getPath()).isEqualTo(folder);
        assertThat(location.toUri().getScheme()).isEqualTo("file");
    }
}
