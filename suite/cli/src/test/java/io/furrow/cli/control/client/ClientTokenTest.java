package io.furrow.cli.control.client;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ClientTokenTest {
    @TempDir
    Path directory;

    @ParameterizedTest
    @ValueSource(
            strings = {
                "a-token-of-some-length\n",
                "# mine\n\n  a-token-of-some-length  \n",
                "ann a-token-of-some-length operator\nbob another-token-of-bobs admin\n",
                "ann\ta-token-of-some-length\n"
            })
    void readsATokenAndTheFileOfTheControlPlane(String text) throws IOException {
        assertThat(ClientToken.find(file(text), Map.of("FURROW_TOKEN", "from-the-environment")))
                .contains("a-token-of-some-length");
    }

    @Test
    void takesVariablesWhereNoFileIsNamed() throws IOException {
        String file = file("from-a-file").toString();

        assertThat(ClientToken.find(null, Map.of())).isEmpty();
        assertThat(ClientToken.find(null, Map.of("FURROW_TOKEN", " one "))).contains("one");
        assertThat(ClientToken.find(null, Map.of("FURROW_TOKEN_FILE", file))).contains("from-a-file");
        assertThat(ClientToken.find(null, Map.of("FURROW_TOKEN", "one", "FURROW_TOKEN_FILE", file)))
                .contains("one");
    }

    @Test
    void reportsWhereAFileIsMissingOrEmpty() throws IOException {
        Path empty = file("# nothing\n");

        assertThatThrownBy(() -> ClientToken.find(empty, Map.of()))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("--token-file " + empty, "holds no token");
        assertThatThrownBy(() -> ClientToken.find(null, Map.of("FURROW_TOKEN_FILE", "nosuch")))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("$FURROW_TOKEN_FILE nosuch cannot be read");
    }

    private Path file(String text) throws IOException {
        return Files.writeString(directory.resolve("token"), text);
    }
}
