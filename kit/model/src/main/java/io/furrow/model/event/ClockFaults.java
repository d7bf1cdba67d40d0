package io.furrow.model.event;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;

import io.furrow.model.text.LogText;

/** Describes once per device and fault that it sends no plausible time. Tracks 10 000 devices and drops the one that was silent longest. */
public final class ClockFaults {
    private final String maxSkewOption;
    private final Map<String, Boolean> described;

    /** @param maxSkewOption name of the option for {@link EventTimeRule#maxSkew} */
    public ClockFaults(String maxSkewOption) {
        this(maxSkewOption, 10_000);
    }

    ClockFaults(String maxSkewOption, int remembered) {
        this.maxSkewOption = maxSkewOption;
        described = new LinkedHashMap<>(16, 0.75f, true) {
            private static final long serialVersionUID = 1L;

            @Override
            protected boolean removeEldestEntry(Map.Entry<String, Boolean> eldest) {
                return size() > remembered;
            }
        };
    }

    /**
     * Returns a line for the log; empty unless this is the first such event of a tracked device.
     *
     * @param device tenant, service path and id
     */
    public synchronized Optional<String> describe(String device, EventTime.Fault fault) {
        if (described.put(fault + " " + device, true) != null) {
            return Optional.empty();
        }
        String what = switch (fault) {
            case AHEAD -> "is too far ahead; its events get the time of receipt. Correct it, or raise " + maxSkewOption;
            case UNSET -> "is more than ten years behind; its events get the time of receipt. Set it";
            case UNREADABLE -> "gives a time that cannot be read; its events do without. Send ISO 8601 or epoch ms";
        };
        return Optional.of("The clock of " + LogText.oneLine(device) + " " + what);
    }
}
