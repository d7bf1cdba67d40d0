package io.furrow.simulators.host;

import java.util.Map;
import java.util.function.Supplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.SecretFingerprints;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The secret that a host uses: what it was given, as long as that is the farm's, whose fingerprints are on {@code service.secrets}.
 * One thread changes it, any may ask for it.
 */
final class FarmSecretCheck implements Supplier<FarmSecret> {
    private static final Logger LOG = LoggerFactory.getLogger(FarmSecretCheck.class);

    private final Supplier<FarmSecret> given;
    private FarmSecret newest;
    private volatile FarmSecret used;
    private SecretFingerprints farms;

    /** The host has a secret that is not the farm's: no login that it makes is known to the MQTT broker. */
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
     * Takes records of the topic.
     *
     * @throws AnotherSecretException if the farm has another secret; one that was rotated once more is only reported, because the
     *     host's passwords count for a time
     */
    void take(Map<String, byte[]> records) throws AnotherSecretException {
        byte[] value = records.get(SecretFingerprints.KEY);
        if (value == null) {
            return;
        }
        try {
            farms = SecretFingerprints.read(value);
        } catch (UnreadableException e) {
            LOG.warn("the fingerprints of the farm's secret cannot be read and are passed over", e);
            return;
        }
        SecretFingerprints mine = SecretFingerprints.of(used);
        switch (mine.to(farms)) {
            case ANOTHER -> throw new AnotherSecretException(farms, mine);
            case OLDER ->
                LOG.warn(
                        "the farm's secret was rotated: its newest key is {}, that of this host {}. Give the host a copy of the control plane's file before the old passwords cease to count",
                        farms,
                        mine);
            default -> LOG.debug("the secret of this host is that of the farm, {}", mine);
        }
    }

    /** Takes up what the host was given since it was asked last, if it is the farm's. @return whether it did */
    boolean isChanged() {
        FarmSecret now = given.get();
        if (now.equals(newest)) {
            return false;
        }
        newest = now;
        SecretFingerprints mine = SecretFingerprints.of(now);
        if (farms != null && mine.to(farms) == SecretFingerprints.Relation.ANOTHER) {
            LOG.warn(
                    "{}; until then the one from before stays in use",
                    new AnotherSecretException(farms, mine).getMessage());
            return false;
        }
        used = now;
        return true;
    }
}
