package io.furrow.simulators.host;

import java.util.Map;
import java.util.function.Supplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.SecretFingerprints;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Provides the secret of a host: the given one, as long as it matches the farm's fingerprints on {@code
 * service.secrets}. One thread changes it, any may read it.
 */
final class FarmSecretCheck implements Supplier<FarmSecret> {
    private static final Logger LOG = LoggerFactory.getLogger(FarmSecretCheck.class);

    private final Supplier<FarmSecret> given;
    private FarmSecret newest;
    private volatile FarmSecret used;
    private SecretFingerprints farms;

    /** The secret of the host is not the farm's: the MQTT broker accepts none of its logins. */
    static final class AnotherSecretException extends Exception {
        private static final long serialVersionUID = 1L;

        AnotherSecretException(SecretFingerprints farms, SecretFingerprints own) {
            super(
                    "this farm has another secret: its newest key is %s, that of this host %s. Give the host a copy of the control plane's file"
                            .formatted(farms, own));
        }
    }

    FarmSecretCheck(Supplier<FarmSecret> given) {
        this.given = given;
        this.newest = given.get();
        this.used = newest;
    }

    @Override
    public FarmSecret get() {
        return used;
    }

    /**
     * Processes records of the topic.
     *
     * @throws AnotherSecretException if the farm has another secret; one rotated once more only causes a warning,
     *     because old passwords stay valid for a time
     */
    void take(Map<String, byte[]> records) throws AnotherSecretException {
        byte[] value = records.get(SecretFingerprints.KEY);
        if (value == null) {
            return;
        }
        try {
            farms = SecretFingerprints.read(value);
        } catch (UnreadableException e) {
            LOG.warn("the fingerprints of the farm's secret cannot be read and are ignored", e);
            return;
        }
        SecretFingerprints mine = SecretFingerprints.of(used);
        switch (mine.to(farms)) {
            case ANOTHER -> throw new AnotherSecretException(farms, mine);
            case OLDER ->
                LOG.warn(
                        "the farm's secret was rotated: its newest key is {}, that of this host {}. Give the host a copy of the control plane's file before the old passwords expire",
                        farms,
                        mine);
            default -> LOG.debug("the secret of this host is that of the farm, {}", mine);
        }
    }

    /** Adopts a changed secret, if it is the farm's; returns whether it did. */
    boolean isChanged() {
        FarmSecret now = given.get();
        if (now.equals(newest)) {
            return false;
        }
        newest = now;
        SecretFingerprints mine = SecretFingerprints.of(now);
        if (farms != null && mine.to(farms) == SecretFingerprints.Relation.ANOTHER) {
            LOG.warn(
                    "{}; until then the previous one stays in use",
                    new AnotherSecretException(farms, mine).getMessage());
            return false;
        }
        used = now;
        return true;
    }
}
