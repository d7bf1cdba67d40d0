package io.furrow.control.rest.access;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.control.Role;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ApiTokenTest {
    @TempDir
    Path directory;

    @Test
    void readsTokensWithViewerAsDefaultRole() throws Exception {
        List<ApiToken> tokens = ApiToken.read(file("""
                # the farm's

                ann a-token-of-sixteen-signs admin
                bob@farm  another-token-of-signs
                ann the-next-token-of-ann operator
                """));

        assertThat(tokens).hasToString("[ann (admin), bob@farm (viewer), ann (operator)]");
        assertThat(ApiToken.find(tokens, "a-token-of-sixteen-signs")).contains(tokens.get(0));
        assertThat(ApiToken.find(tokens, "the-next-token-of-ann")).contains(tokens.get(2));
        assertThat(ApiToken.find(tokens, "a-token-of-sixteen-sign")).isEmpty();
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    ann a-token-of-sixteen-signs;bob short         | line 2: a line is '<name> <token> <role>', the token at least 16 characters long
                    a-token-of-sixteen-signs                       | line 1: a line is
                    ann a-token-of-sixteen-signs root              | line 1: 'root' is not a role; it is viewer, operator or admin
                    ann a-token-of-sixteen-signs admin now         | line 1: a line is
                    ann a-token-of-sixteen-signs;;bob a-token-of-sixteen-signs admin | line 3: an earlier line has the same token
                    ann a-token-of-sixteen-signs for-users         | line 1: 'for-users' is not a role
                    # nobody                                       | holds no token
                    """)
    void namesTheInvalidLine(String lines, String message) {
        assertThatThrownBy(() -> ApiToken.read(file(lines.replace(';', '\n'))))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll(directory.toString(), message);
    }

    @Test
    void readsTokensForUsers() throws Exception {
        List<ApiToken> tokens = ApiToken.read(file("""
                dashboard a-token-of-sixteen-signs operator for-users
                ann another-token-of-signs admin
                """));

        assertThat(tokens).extracting(ApiToken::forUsers).containsExactly(true, false);
        assertThat(tokens.get(0).onBehalfOf("vera", Role.VIEWER)).hasToString("vera (viewer)");
        assertThat(tokens.get(0).onBehalfOf("vera", Role.ADMIN)).hasToString("vera (operator)");
    }

    @Test
    void namesTheMissingFile() {
        assertThatThrownBy(() -> ApiToken.read(directory.resolve("missing")))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("the file of tokens", "missing", "cannot be read");
    }

    private Path file(String text) throws IOException {
        return Files.writeString(directory.resolve("tokens"), text);
    }
}
