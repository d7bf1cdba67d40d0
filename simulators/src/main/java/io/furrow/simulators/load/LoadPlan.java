package io.furrow.simulators.load;

import java.time.Duration;

/**
 * A load: {@code devices} each send one measure per {@code period} for {@code duration}.
 *
 * @param payloadBytes length of the text {@code payload} of each measure, ASCII; at least {@value #LEAST_PAYLOAD}
 * @param domain the devices' {@code Domain}
 * @param mission the devices' {@code Mission}, first part of their ids
 */
public record LoadPlan(
        int devices, Duration period, int payloadBytes, Duration duration, String domain, String mission) {
    /** What the head that makes payloads distinct may need. */
    public static final int LEAST_PAYLOAD = 40;

    public LoadPlan {
        if (devices < 1 || period.toMillis() < 1 || duration.compareTo(period) < 0) {
            throw new IllegalArgumentException(
                    "a load needs at least one device, a period of at least 1 ms and a duration of at least one period");
        }
        if (payloadBytes < LEAST_PAYLOAD) {
            throw new IllegalArgumentException("payload of %d bytes: it must be at least %d, which number the messages"
                    .formatted(payloadBytes, LEAST_PAYLOAD));
        }
    }

    /** How many messages that makes: devices × whole periods in the duration. */
    public long messages() {
        return devices * duration.dividedBy(period);
    }
}
