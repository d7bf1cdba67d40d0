package io.furrow.connect.source;

import java.util.LinkedHashMap;
import java.util.Map;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;

/**
 * Logs each device whose clock is too far ahead once. Remembers 10 000 devices and forgets the one that was silent
 * longest.
 */
final class ClockReport {
    private static final Logger LOG = LoggerFactory.getLogger(ClockReport.class);

    private final Map<String, Boolean> reported;

    ClockReport() {
        this(10_000);
    }

    ClockReport(int remembered) {
        reported = new LinkedHashMap<>(16, 0.75f, true) {
            private static final long serialVersionUID = 1L;

            @Override
            protected boolean removeEldestEntry(Map.Entry<String, Boolean> eldest) {
                return size() > remembered;
            }
        };
    }

    /** Whether this is the first such event of its device, as far as remembered. */
    synchronized boolean note(String device) {
        if (reported.put(device, true) != null) {
            return false;
        }
        LOG.warn(
                "The clock of {} is too far ahead; its events get the time of receipt. Correct the device, or raise {}",
                LogText.oneLine(device),
                "max.clock.skew.ms");
        return true;
    }
}
