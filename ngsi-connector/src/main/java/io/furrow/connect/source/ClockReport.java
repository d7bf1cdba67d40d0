package io.furrow.connect.source;

import java.util.LinkedHashMap;
import java.util.Map;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;
import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTime;

/** Names each device whose clock is too far ahead once in the log; forgets the longest silent of more than 10 000. */
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

    /** Whether this is the first event of its device with such a clock, as far as remembered. */
    synchronized boolean note(EntityEvent event) {
        if (event.time().basis() != EventTime.Basis.RECEIPT_FOR_FUTURE) {
            return false;
        }
        String device = event.scope().identity(event.entity().id());
        if (reported.put(device, true) != null) {
            return false;
        }
        LOG.warn(
                "The clock of {} is too far ahead; its events get the time of receipt. Check the device, or raise {}",
                LogText.oneLine(device),
                "max.clock.skew.ms");
        return true;
    }
}
