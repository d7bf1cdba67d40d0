package io.furrow.model.device;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FarmSecretTest {
    private final FarmSecret secret = new FarmSecret("0123456789abcdef".getBytes(StandardCharsets.UTF_8));

    @Test
    void alwaysMakesTheSameOfTheSame() {
        FarmSecret again = new FarmSecret("0123456789abcdef".getBytes(StandardCharsets.UTF_8));

        assertThat(again.apiKey("weeding")).isEqualTo(secret.apiKey("weeding")).matches("[A-Za-z0-9_-]{22}");
        assertThat(again.device("weeding", "t-1")).isEqualTo(secret.device("weeding", "t-1"));
    }

    @Test
    void givesEachMissionDeviceAndUseItsOwn() {
        assertThat(new String[] {
                    secret.apiKey("a"),
                    secret.apiKey("b"),
                    secret.gateway("a").password(),
                    secret.device("a", "t-1").password(),
                    secret.device("a", "t-2").password(),
                    secret.device("b", "t-1").password(),
                    new FarmSecret("another one of 16".getBytes(StandardCharsets.UTF_8)).apiKey("a")
                })
                .doesNotHaveDuplicates();
    }

    @Test
    void namesNoTwoDevicesAlikeAndUsesNoColon() {
        assertThat(secret.device("a", "urn:ngsi-ld:T:1").user()).isEqualTo("a.urn%3Angsi-ld%3AT%3A1");
        assertThat(secret.device("a", "urn%3A1").user())
                .isNotEqualTo(secret.device("a", "urn:1").user());
        assertThat(secret.gateway("a").user()).isEqualTo("a");
    }

    @Test
    void tellsNoPasswordWhereALoginIsPrinted() {
        FarmSecret.Login login = secret.device("a", "t");

        assertThat(login.toString()).isEqualTo("a.t").doesNotContain(login.password());
    }

    @Test
    void readsTheFirstLineOfAFileAndRefusesAShortOne(@TempDir Path folder) throws IOException {
        Path good = Files.writeString(folder.resolve("good"), "0123456789abcdef\n");
        Path bad = Files.writeString(folder.resolve("bad"), "short\n");

        assertThat(FarmSecret.read(good).apiKey("a")).isEqualTo(secret.apiKey("a"));
        assertThatThrownBy(() -> FarmSecret.read(bad))
                .isInstanceOf(IOException.class)
                .hasMessageContaining(bad.toString())
                .hasMessageContaining("at least 16 bytes, this one 5");
    }
}
