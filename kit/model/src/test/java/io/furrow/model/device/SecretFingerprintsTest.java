package io.furrow.model.device;

import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.SecretFingerprints.Relation;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class SecretFingerprintsTest {
    private static final Instant NOW = Instant.parse("2026-03-01T08:00:00Z");

    private final FarmSecret first = FarmSecret.generate();
    private final FarmSecret second = first.rotated(NOW, NOW.plusSeconds(60), false);

    @Test
    void distinguishesOlderAndNewerSecretsFromOthers() {
        assertThat(relation(first, first)).isEqualTo(Relation.SAME);
        assertThat(relation(second, first)).isEqualTo(Relation.NEWER);
        assertThat(relation(first, second)).isEqualTo(Relation.OLDER);
        assertThat(relation(FarmSecret.generate(), first)).isEqualTo(Relation.ANOTHER);
        assertThat(relation(first.rotated(NOW, NOW, true), first)).isEqualTo(Relation.NEWER);
    }

    /** Two rotations of copies of a file produce two secrets. */
    @Test
    void distinguishesTwoRotationsOfOneSecret() {
        FarmSecret twin = first.rotated(NOW, NOW.plusSeconds(60), false);

        assertThat(relation(twin, second)).isEqualTo(Relation.ANOTHER);
        assertThat(relation(twin.rotated(NOW, NOW, false), second)).isEqualTo(Relation.ANOTHER);
    }

    @Test
    void rejectsASecretWithoutASharedKey() {
        FarmSecret unrelated = new FarmSecret(
                List.of(new FarmKey(7, "0123456789abcdef", null)), new FarmKey(7, "0123456789abcdef", null));

        assertThat(relation(unrelated, first)).isEqualTo(Relation.ANOTHER);
    }

    @Test
    void staysTheSameWithoutAnExpiredKey() {
        FarmSecret third = second.rotated(NOW, NOW, true);
        FarmSecret without = new FarmSecret(third.keys().subList(0, 1), third.apiKeys());

        assertThat(relation(without, third)).isEqualTo(Relation.SAME);
    }

    @Test
    void readsBackARecordThatContainsNoKey() throws Exception {
        SecretFingerprints fingerprints = SecretFingerprints.of(second);
        String json = new String(fingerprints.toBytes(), UTF_8);

        assertThat(SecretFingerprints.read(fingerprints.toBytes())).isEqualTo(fingerprints);
        assertThat(json)
                .isEqualTo("{\"newest\":2,\"apiKeys\":1,\"fingerprints\":{\"1\":\"%s\",\"2\":\"%s\"}}"
                        .formatted(first.fingerprint(), second.fingerprint()))
                .doesNotContain(first.newest().text(), second.newest().text());
        assertThat(fingerprints.toString()).isEqualTo(second.toString());
        assertThatThrownBy(() -> SecretFingerprints.read("{\"newest\":1}".getBytes(UTF_8)))
                .isInstanceOf(UnreadableException.class);
    }

    private static Relation relation(FarmSecret own, FarmSecret farms) {
        return SecretFingerprints.of(own).to(SecretFingerprints.of(farms));
    }
}
