package io.furrow.connect.source.notification;

import java.util.LinkedHashMap;
import java.util.Map;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;
import io.furrow.model.event.EventTime;

/** Logs once per device and fault that it sends no plausible time. Tracks 10 000 devices and drops the one that was silent longest. */
final class ClockWarning {
    private static final Logger LOG = LoggerFactory.getLogger(ClockWarning.class);

    private final Map<String, Boolean> reported;

    ClockWarning() {
        this(10_000);
    }

    ClockWarning(int remembered) {
        reported = new LinkedHashMap<>(16, 0.75f, true) {
            private static final long serialVersionUID = 1L;

            @Override
            protected boolean removeEldestEntry(Map.Entry<String, Boolean> eldest) {
                return size() > remembered;
            }
        };
    }

    /** Whether this is the first such event of a tracked device. */
    synchronized boolean note(String device, EventTime.Fault fault) {
        if (reported.put(fault + " " + device, true) != null) {
            return false;
        }
        String what = switch (fault) {
            case AHEAD ->
                "is too far ahead; its events get the time of receipt. Correct it, or raise max.clock.skew.ms";
            case UNSET -> "is more than ten years behind; its events get the time of receipt. Set it";
            case UNREADABLE -> "gives a time that cannot be read; its events do without. Send ISO 8601 or epoch ms";
        };
        LOG.warn("The clock of {} {}", LogText.oneLine(device), what);
        return true;
    }
}
