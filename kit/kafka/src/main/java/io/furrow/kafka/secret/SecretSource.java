package io.furrow.kafka.secret;

import java.io.IOException;
import java.util.Optional;
import java.util.function.Supplier;

import io.furrow.model.device.FarmSecret;

/** Provides the farm's secret, which may be rotated while the process runs. Thread-safe. */
public interface SecretSource extends Supplier<FarmSecret> {
    /** The current secret: no login is accepted with expired keys. */
    @Override
    FarmSecret get();

    /**
     * Checks that it is the secret of the farm.
     *
     * @throws IOException if the farm has another or a newer one, or the check fails; the message says what to do
     */
    void verify() throws IOException;

    /** Why the last secret provided is not in use; empty if it is. */
    default Optional<String> problem() {
        return Optional.empty();
    }

    /** A constant secret that is not checked. */
    static SecretSource of(FarmSecret secret) {
        return new SecretSource() {
            @Override
            public FarmSecret get() {
                return secret;
            }

            @Override
            public void verify() {
                // No check is needed.
            }
        };
    }
}
