package io.furrow.kafka.secret;

import java.io.IOException;
import java.util.Optional;
import java.util.function.Supplier;

import io.furrow.model.device.FarmSecret;

/** The farm's secret as a process knows it, which may be rotated while the process runs. Safe from all threads. */
public interface SecretSource extends Supplier<FarmSecret> {
    /** The secret as it is now: of keys whose time is over no login is accepted. */
    @Override
    FarmSecret get();

    /**
     * Checks that it is the secret of the farm.
     *
     * @throws IOException if the farm has another or a newer one, or that cannot be found out; the message says what to do
     */
    void verify() throws IOException;

    /** Why the secret that it was last given is not in use; empty if it is. */
    default Optional<String> problem() {
        return Optional.empty();
    }

    /** One that never changes and is the farm's without being asked. */
    static SecretSource of(FarmSecret secret) {
        return new SecretSource() {
            @Override
            public FarmSecret get() {
                return secret;
            }

            @Override
            public void verify() {
                // It is known to be.
            }
        };
    }
}
