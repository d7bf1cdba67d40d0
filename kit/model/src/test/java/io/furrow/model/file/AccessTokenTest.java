package io.furrow.model.file;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.attribute.FileTime;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

class AccessTokenTest {
    @TempDir
    Path directory;

    private final List<String> warnings = new ArrayList<>();

    @Test
    void sendsTheCurrentTokenOfTheFile() throws Exception {
        Path file = Files.writeString(directory.resolve("token"), "Bearer first \nsecond\n");
        AccessToken token = AccessToken.of(file, "Authorization", warnings::add);
        assertThat(headers(token)).containsExactly(Map.entry("Authorization", "Bearer first"));

        Files.writeString(file, "Bearer other\n");
        Files.setLastModifiedTime(file, FileTime.fromMillis(0));
        await().untilAsserted(() -> assertThat(headers(token)).containsValue("Bearer other"));

        Files.delete(file);
        await().untilAsserted(() -> {
            assertThat(headers(token)).containsValue("Bearer other");
            assertThat(warnings).last().asString().contains("cannot be read");
        });
        assertThat(warnings.toString() + token).doesNotContain("other");
    }

    @Test
    void sendsNothingWithoutATokenAndUsesTheHeaderOfWilmaByDefault() throws Exception {
        assertThat(headers(AccessToken.NONE)).isEmpty();
        Path file = Files.writeString(directory.resolve("token"), "abc");
        assertThat(headers(AccessToken.of(file, null, warnings::add)))
                .containsExactly(Map.entry("X-Auth-Token", "abc"));
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "\nabc", "ü", "a\tb"})
    void rejectsAFileWithoutAToken(String text) throws Exception {
        Path file = Files.writeString(directory.resolve("token"), text);

        assertThatThrownBy(() -> AccessToken.of(file, null, warnings::add))
                .isInstanceOf(IOException.class)
                .hasMessageContaining(file + " holds no token");
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "Host", "a b", "X:Y"})
    void rejectsAnInvalidHeader(String header) throws Exception {
        Path file = Files.writeString(directory.resolve("token"), "abc");

        assertThatThrownBy(() -> AccessToken.of(file, header, warnings::add))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("'" + header + "' is not a header");
    }

    private static Map<String, String> headers(AccessToken token) {
        Map<String, String> headers = new HashMap<>();
        token.addTo(headers::put);
        return headers;
    }
}
