package io.furrow.model.device;

import java.time.Duration;
import java.time.Instant;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.FarmSecret.Login;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FarmSecretTest {
    private static final Instant NOW = Instant.parse("2026-03-01T08:00:00Z");
    private static final Instant LATER = NOW.plus(Duration.ofDays(30));

    private final FarmSecret secret = new FarmSecret(bytes("0123456789abcdef"));

    @Test
    void derivesTheSameCredentialsEachTime() {
        FarmSecret again = new FarmSecret(bytes("0123456789abcdef"));

        assertThat(again).isEqualTo(secret);
        assertThat(again.device("weeding", "t-1")).isEqualTo(secret.device("weeding", "t-1"));
        // All versions derive these, so that devices need not be provisioned again.
        assertThat(secret.apiKey("weeding")).isEqualTo("F49lKHQxb5Oi2OVXvRUbeD");
    }

    @Test
    void derivesDifferentCredentialsPerMissionDeviceUseAndGeneration() {
        assertThat(new String[] {
                    secret.apiKey("a"),
                    secret.apiKey("b"),
                    secret.gateway("a").password(),
                    secret.device("a", "t-1").password(),
                    secret.device("a", "t-1", 1).password(),
                    secret.device("a", "t-2").password(),
                    secret.device("b", "t-1").password(),
                    secret.fingerprint(),
                    new FarmSecret(bytes("another one of 16")).apiKey("a")
                })
                .doesNotHaveDuplicates();
    }

    @Test
    void prefixesItsUsers() {
        assertThat(secret.device("a", "urn:ngsi-ld:T:1").user()).isEqualTo("furrow.d.a.urn%3Angsi-ld%3AT%3A1.1.0");
        assertThat(secret.device("a", "t 1.x*", 12).user()).isEqualTo("furrow.d.a.t%201%2Ex%2A.1.12");
        assertThat(secret.gateway("agent").user()).isEqualTo("furrow.m.agent.1");
    }

    /** Tests names designed to collide, with separators, dots and numbers in their parts. */
    @Test
    void givesNoTwoLoginsTheSameUser() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        List<String> parts = List.of("a", ".", "1", "%2E", "d", "m", ":", "+", " ", "ü", "/", "#");
        Set<List<String>> logins = new HashSet<>();
        Set<String> users = new HashSet<>();
        for (int i = 0; i < 20_000; i++) {
            String mission = word(random, parts);
            String device = word(random, parts);
            int generation = random.nextInt(3);
            if (logins.add(List.of(mission, device, generation + ""))) {
                assertThat(users.add(secret.device(mission, device, generation).user()))
                        .as("seed %d: '%s' '%s' %d", seed, mission, device, generation)
                        .isTrue();
            }
            if (logins.add(List.of(mission))) {
                assertThat(users.add(secret.gateway(mission).user()))
                        .as("seed %d: '%s'", seed, mission)
                        .isTrue();
            }
        }
        assertThat(users).allMatch(user -> user.matches("furrow\\.[dm](\\.[A-Za-z0-9_%-]*)+"));
    }

    private static String word(Random random, List<String> parts) {
        StringBuilder word = new StringBuilder();
        for (int i = random.nextInt(4); i >= 0; i--) {
            word.append(parts.get(random.nextInt(parts.size())));
        }
        return word.toString();
    }

    @Test
    void showsNoPasswordAndNoKey() {
        Login login = secret.device("a", "t");

        assertThat(login.toString()).isEqualTo("furrow.d.a.t.1.0").doesNotContain(login.password());
        assertThat(secret.toString()).isEqualTo(secret.fingerprint() + " (key 1)");
        assertThat(secret.keys().toString()).doesNotContain("0123456789abcdef");
        assertThat(secret.fingerprint()).matches("[0-9a-f]{16}");
    }

    @Test
    void namesUsersTheSameInAllLocales() {
        Locale usual = Locale.getDefault();
        Locale.setDefault(Locale.forLanguageTag("ar-EG"));
        try {
            assertThat(secret.device("a", "t").user()).isEqualTo("furrow.d.a.t.1.0");
            assertThat(secret.gateway("a").user()).isEqualTo("furrow.m.a.1");
        } finally {
            Locale.setDefault(usual);
        }
    }

    @Test
    void rejectsAShortSecret() {
        assertThatThrownBy(() -> new FarmSecret(bytes("plough")))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContainingAll("at least 16 bytes, this one 6", "./furrow secret new");
    }

    @Test
    void generatesAnotherSecretEachTime() {
        assertThat(FarmSecret.generate().fingerprint())
                .isNotEqualTo(FarmSecret.generate().fingerprint());
    }

    @Test
    void acceptsOldPasswordsUntilTheirExpiryAndKeepsTheApiKeys() {
        FarmSecret rotated = secret.rotated(NOW, LATER, false);

        assertThat(rotated.apiKey("a")).isEqualTo(secret.apiKey("a"));
        assertThat(rotated.device("a", "t").user()).isEqualTo("furrow.d.a.t.2.0");
        assertThat(rotated.at(NOW).devices("a", "t", 0))
                .containsExactly(rotated.device("a", "t"), secret.device("a", "t"));
        assertThat(rotated.at(NOW).gateways("a")).containsExactly(rotated.gateway("a"), secret.gateway("a"));

        assertThat(rotated.at(LATER).devices("a", "t", 0)).containsExactly(rotated.device("a", "t"));
        assertThat(rotated.at(LATER).gateways("a")).containsExactly(rotated.gateway("a"));
        assertThat(rotated.at(LATER)).isNotEqualTo(rotated.at(NOW));
        assertThat(rotated.at(NOW)).isEqualTo(rotated.at(LATER.minusSeconds(1)));
    }

    @Test
    void dropsExpiredKeysExceptThatOfApiKeys() {
        FarmSecret third = secret.rotated(NOW, LATER, false).rotated(LATER, LATER.plusSeconds(9), false);
        FarmSecret fourth = third.rotated(LATER.plusSeconds(9), LATER.plusSeconds(20), false);

        assertThat(third.keys()).extracting(FarmKey::number).containsExactly(3, 2, 1);
        assertThat(fourth.keys()).extracting(FarmKey::number).containsExactly(4, 3, 1);
        assertThat(fourth.apiKey("a")).isEqualTo(secret.apiKey("a"));
    }

    @Test
    void recognizesItsEarlierApiKeys() {
        FarmSecret other = secret.rotated(NOW, NOW, true);

        assertThat(other.apiKey("a")).isNotEqualTo(secret.apiKey("a"));
        assertThat(other.madeApiKey(secret.apiKey("a"), "a")).isTrue();
        assertThat(other.madeApiKey(other.apiKey("a"), "a")).isTrue();
        assertThat(other.madeApiKey(secret.apiKey("a"), "b")).isFalse();
        assertThat(secret.madeApiKey(other.apiKey("a"), "a")).isFalse();
        assertThat(other.at(NOW).devices("a", "t", 0)).containsExactly(other.device("a", "t"));
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }
}
