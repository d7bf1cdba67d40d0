package io.furrow.simulators.load;

import java.time.Duration;

/**
 * A load: {@code devices} each send one measure per {@code period} for {@code duration}.
 *
 * @param payloadBytes length of the ASCII text {@code payload} of each measure, at least {@value #MIN_PAYLOAD}
 * @param domain the devices' {@code Domain}
 * @param mission the devices' {@code Mission}, first part of their ids
 */
public record LoadPlan(
        int devices, Duration period, int payloadBytes, Duration duration, String domain, String mission) {
    /** Space for the head that makes payloads distinct. */
    public static final int MIN_PAYLOAD = 40;

    public LoadPlan {
        if (devices < 1 || period.toMillis() < 1 || duration.compareTo(period) < 0) {
            throw new IllegalArgumentException(
                    "a load needs at least one device, a period of at least 1 ms and a duration of at least one period");
        }
        if (payloadBytes < MIN_PAYLOAD) {
            throw new IllegalArgumentException("payload of %d bytes: it must be at least %d, which number the messages"
                    .formatted(payloadBytes, MIN_PAYLOAD));
        }
    }

    /** Number of messages: devices × whole periods in the duration. */
    public long messages() {
        return devices * duration.dividedBy(period);
    }
}
