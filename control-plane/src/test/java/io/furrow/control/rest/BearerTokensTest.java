package io.furrow.control.rest;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.control.ControlSettings;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class BearerTokensTest {
    @TempDir
    Path directory;

    @Test
    void readsAFileOfTokens() throws Exception {
        assertThat(BearerTokens.read(
                        file("# the farm's\n\nann a-token-of-sixteen-signs\nbob@farm  another-token-of-signs\n")))
                .isNotNull();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    ann a-token-of-sixteen-signs;bob short         | line 2: a line is '<name> <token>', the token at least 16 signs long
                    a-token-of-sixteen-signs                       | line 1: a line is
                    ann a-token-of sixteen-signs-with-a-blank      | line 1: a line is
                    # nobody                                       | holds no token
                    """)
    void namesTheLineThatIsNone(String lines, String message) {
        assertThatThrownBy(() -> BearerTokens.read(file(lines.replace(';', '\n'))))
                .isInstanceOf(IOException.class)
                .hasMessageContaining(directory.toString())
                .hasMessageContaining(message);
    }

    @Test
    void isNeededWhereOthersCanReachTheApi() {
        ControlSettings nowhere = ControlSettings.of(new java.util.Properties());

        assertThatThrownBy(() -> RestApi.start(nowhere, RestSettings.on(0).withHost("0.0.0.0"), () -> "RUNNING"))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("listens on 0.0.0.0 only with tokens");
    }

    private Path file(String text) throws IOException {
        return Files.writeString(directory.resolve("tokens"), text);
    }
}
