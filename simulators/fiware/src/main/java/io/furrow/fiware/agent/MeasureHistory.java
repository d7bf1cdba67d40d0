package io.furrow.fiware.agent;

import java.nio.charset.StandardCharsets;
import java.time.Clock;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.function.UnaryOperator;

/**
 * Tracks the last measure of each device, and the messages that the agent could not read; an agent of FIWARE only logs them.
 * Tracks the newest devices and the newest unknown senders only, because any client that may publish can name any number of them.
 * Thread-safe.
 */
public final class MeasureHistory {
    private static final int MAX_DEVICES = 100_000;
    private static final int MAX_STRANGERS = 1000;
    private static final int MAX_NAME = 256;
    private static final int MAX_PAYLOAD = 200;

    private final Clock clock;
    private final Map<Sender, Received> devices = newest(MAX_DEVICES);
    private final Map<Sender, Received> strangers = newest(MAX_STRANGERS);

    /** The two variable parts of a topic. */
    private record Sender(String apikey, String device) {}

    /**
     * The messages of a device; all times are epoch ms.
     *
     * @param measured time of the last readable measure; null if there is none
     * @param ignored the newest rejected message; null if there is none
     */
    public record Received(Long measured, Ignored ignored) {}

    /**
     * Rejected messages.
     *
     * @param reason of the last one
     * @param payload the first bytes of the last one
     */
    public record Ignored(long count, long last, String reason, String payload) {}

    public MeasureHistory(Clock clock) {
        this.clock = clock;
    }

    private static Map<Sender, Received> newest(int max) {
        return new LinkedHashMap<>(16, 0.75f, true) {
            private static final long serialVersionUID = 1L;

            @Override
            protected boolean removeEldestEntry(Map.Entry<Sender, Received> eldest) {
                return size() > max;
            }
        };
    }

    /** The messages of a device, or under an unknown name; empty if there are none, or only very old ones. */
    public synchronized Optional<Received> of(String apikey, String device) {
        Sender sender = new Sender(apikey, device);
        return Optional.ofNullable(devices.getOrDefault(sender, strangers.get(sender)));
    }

    void measured(String apikey, String device) {
        update(devices, apikey, device, existing -> new Received(clock.millis(), existing.ignored()));
    }

    void unreadable(String apikey, String device, byte[] payload, String reason) {
        ignored(devices, apikey, device, payload, reason);
    }

    void unknown(String apikey, String device, byte[] payload, String reason) {
        ignored(strangers, apikey, device, payload, reason);
    }

    private void ignored(Map<Sender, Received> among, String apikey, String device, byte[] payload, String reason) {
        String begin = new String(payload, 0, Math.min(payload.length, MAX_PAYLOAD), StandardCharsets.UTF_8);
        update(among, apikey, device, existing -> {
            long before = existing.ignored() == null ? 0 : existing.ignored().count();
            return new Received(existing.measured(), new Ignored(before + 1, clock.millis(), reason, begin));
        });
    }

    private synchronized void update(
            Map<Sender, Received> among, String apikey, String device, UnaryOperator<Received> change) {
        if (apikey.length() <= MAX_NAME && device.length() <= MAX_NAME) {
            Sender sender = new Sender(apikey, device);
            among.put(sender, change.apply(among.getOrDefault(sender, new Received(null, null))));
        }
    }
}
