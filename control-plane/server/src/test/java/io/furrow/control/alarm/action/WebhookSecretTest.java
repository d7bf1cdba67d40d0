package io.furrow.control.alarm.action;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class WebhookSecretTest {
    private static final byte[] BODY = "{\"id\":\"collision-7:7\"}".getBytes(UTF_8);

    @TempDir
    Path directory;

    /** Uses the test vector of the control plane's README: printf '1700000000.{"id":"collision-7:7"}' | openssl dgst -sha256 -hmac … */
    @Test
    void signsAsDocumented() throws Exception {
        assertThat(secret("correct horse battery staple\n").signature(1_700_000_000, BODY))
                .isEqualTo("t=1700000000,v1=08d30c56a11e29adb51aa5ee2642298cbb637c24a94b8cbd09975ed0c20453a3");
    }

    @Test
    void signsWithBothSecretsDuringARotation() throws Exception {
        Path file = directory.resolve("secret");
        Files.writeString(file, "the old secret, long\n");
        WebhookSecret secret = WebhookSecret.read(file);
        String old = secret.signature(1, BODY);
        Files.writeString(file, "the new secret, long\n\nthe old secret, long\n");
        String both = secret.signature(1, BODY);
        Files.writeString(file, "the new secret, long\n");
        String fresh = secret.signature(1, BODY);
        assertThat(both).isEqualTo(fresh + old.replace("t=1", ""));
        Files.delete(file);
        assertThat(secret.signature(1, BODY)).isEqualTo(fresh);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "",
                "\n\n",
                "too short",
                "a secret of some length\nanother of some length\na third of some length"
            })
    void rejectsAFileWithoutASecret(String content) {
        assertThatThrownBy(() -> secret(content))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("holds no secret for the webhook", "openssl rand");
    }

    private WebhookSecret secret(String content) throws IOException {
        return WebhookSecret.read(Files.writeString(directory.resolve("content"), content));
    }
}
