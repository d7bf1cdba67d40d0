package io.furrow.simulators.host;

import java.time.Instant;
import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.SecretFingerprints;
import io.furrow.simulators.host.FarmSecretCheck.AnotherSecretException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FarmSecretCheckTest {
    private final FarmSecret first = FarmSecret.generate();
    private final FarmSecret rotated = first.rotated(Instant.EPOCH, Instant.MAX, false);
    private FarmSecret given = first;
    private final FarmSecretCheck check = new FarmSecretCheck(() -> given);

    @Test
    void rejectsTheSecretOfAnotherFarmSayingWhatToDo() {
        FarmSecret farms = FarmSecret.generate();

        assertThatThrownBy(() -> check.take(record(farms)))
                .isInstanceOf(AnotherSecretException.class)
                .hasMessageContainingAll(farms.toString(), first.toString(), "a copy of the control plane's file");
    }

    @Test
    void goesOnWithTheSecretFromBeforeARotationAndTakesTheNewOneUp() throws Exception {
        check.take(record(rotated));
        assertThat(check.get()).isEqualTo(first);
        assertThat(check.isChanged()).isFalse();

        given = rotated;

        assertThat(check.isChanged()).isTrue();
        assertThat(check.get()).isEqualTo(rotated);
        assertThat(check.isChanged()).isFalse();
    }

    @Test
    void doesNotTakeUpTheSecretOfAnotherFarm() throws Exception {
        check.take(record(first));
        given = FarmSecret.generate();

        assertThat(check.isChanged()).isFalse();
        assertThat(check.get()).isEqualTo(first);

        given = rotated;
        assertThat(check.isChanged()).isTrue();
    }

    @Test
    void passesOverWhatItCannotRead() throws Exception {
        check.take(Map.of(SecretFingerprints.KEY, "no".getBytes(UTF_8)));
        check.take(Map.of());

        assertThat(check.get()).isEqualTo(first);
    }

    private static Map<String, byte[]> record(FarmSecret farms) {
        return Map.of(SecretFingerprints.KEY, SecretFingerprints.of(farms).toBytes());
    }
}
